//! Union-find: joins items pair by pair into groups.

/// A forest in which each tree is a group; its root is the group's lowest number.
pub(super) struct Groups {
    parents: Vec<u32>,
}

impl Groups {
    /// Each thing by itself.
    pub(super) fn new(count: usize) -> Self {
        Self { parents: (0..count as u32).collect() }
    }

    fn root(&mut self, mut thing: u32) -> u32 {
        while self.parents[thing as usize] != thing {
            let parent = self.parents[thing as usize];
            self.parents[thing as usize] = self.parents[parent as usize];
            thing = parent;
        }
        thing
    }

    pub(super) fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.parents[a.max(b) as usize] = a.min(b);
    }

    /// Each thing's group, numbered by their first things, and how many there are.
    pub(super) fn numbers(mut self) -> (Vec<u32>, usize) {
        let mut count = 0;
        let mut numbers = vec![0; self.parents.len()];
        for thing in 0..self.parents.len() as u32 {
            let root = self.root(thing);
            numbers[thing as usize] = if root == thing {
                count += 1;
                count - 1
            } else {
                numbers[root as usize]
            };
        }
        (numbers, count as usize)
    }
}
