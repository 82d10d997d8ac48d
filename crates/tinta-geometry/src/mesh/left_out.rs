//! Phrases for the remark on contents of a file that no style draws.

/// A count with its noun; `None` for zero.
pub(super) fn counted(count: usize, one: &str, many: &str) -> Option<String> {
    match count {
        0 => None,
        1 => Some(format!("1 {one}")),
        count => Some(format!("{count} {many}")),
    }
}

/// How the light that materials emit is left out: as light of black ones, whose colour it becomes, and wholly of others.
pub(super) fn emission(of_black: usize, of_others: usize) -> impl Iterator<Item = String> {
    let of_others = counted(of_others, "material's emission", "materials' emission");
    let of_black = counted(
        of_black,
        "black material's emission as light (drawn as its colour)",
        "black materials' emission as light (drawn as their colours)",
    );
    of_others.into_iter().chain(of_black)
}
