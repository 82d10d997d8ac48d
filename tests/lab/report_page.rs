//! The report's page in a browser: no script fails, headers sort, choices choose, the page fits a phone.

use crate::program::said;
use crate::report::{info, made_up_rows};
use crate::support::skip;
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use std::path::Path;
use std::process::Command;
use tinta_lab::measure::Row;
use tinta_lab::report::{html, write};

/// Run inside the page; hands its findings to the page around it.
const CHECK: &str = r##"
(width) => {
  const frame = document.getElementById("w" + width);
  const inside = frame.contentDocument;
  const view = frame.contentWindow;
  const all = (selector) => Array.from(inside.querySelectorAll(selector));
  const shown = (selector) => all(selector).filter((element) => element.getClientRects().length > 0);
  const column = (title) => all("#rows th").findIndex((head) => head.textContent === title);
  const values = (index) => shown("#rows tbody tr").map((row) => row.cells[index].dataset.value ?? row.cells[index].textContent);
  const sorted = (title) => {
    const index = column(title);
    const head = all("#rows th")[index];
    const states = [];
    for (let press = 0; press < 2; press += 1) {
      head.querySelector("button").click();
      states.push({ state: head.getAttribute("aria-sort"), values: values(index) });
    }
    return states;
  };
  const choose = (id, value) => {
    const select = inside.getElementById(id);
    select.value = value;
    select.dispatchEvent(new view.Event("change", { bubbles: true }));
  };
  const found = {
    inner: view.innerWidth, scroll: inside.documentElement.scrollWidth, problems: view.problems,
    wider: shown("main *").filter((element) => !element.closest(".scroll > *, svg")
      && element.getBoundingClientRect().right > view.innerWidth + 0.5).map((element) => element.outerHTML.slice(0, 80)),
    smallestText: Math.min(...shown(".plot svg").flatMap((svg) => Array.from(svg.querySelectorAll("text")).map((text) =>
      parseFloat(text.getAttribute("font-size")) * svg.getBoundingClientRect().width / svg.viewBox.baseVal.width))),
    brokenWords: shown("#rows th button").flatMap((button) => {
      const text = button.firstChild;
      return Array.from(text.data.matchAll(/\S+/g)).filter((word) => {
        const range = inside.createRange();
        range.setStart(text, word.index);
        range.setEnd(text, word.index + word[0].length);
        return range.getClientRects().length > 1 || range.getBoundingClientRect().right > button.getBoundingClientRect().right + 0.5;
      }).map((word) => word[0]);
    }),
    rows: shown("#rows tbody tr").length, plots: shown(".plot svg").length,
    headers: shown("#rows th").length, time: sorted("Clock, ms"), model: sorted("Model"), f1: sorted("Lines F1"),
  };
  choose("choose-model", "fandisk.obj");
  choose("choose-style", "inking");
  found.chosenRows = shown("#rows tbody tr").map((row) => row.dataset.model + " " + row.dataset.style);
  found.chosenPlots = shown(".plot").map((plot) => plot.dataset.model);
  found.chosenPictures = shown(".pictures img").length;
  found.count = inside.getElementById("count").textContent;
  inside.querySelector("#all-columns input").click();
  found.allHeaders = shown("#rows th").length;
  found.scrollAfter = inside.documentElement.scrollWidth;
  return found;
}"##;

/// The findings at each width, or `None` where no browser is installed.
fn in_browser(page: &str, widths: [u32; 2]) -> Option<serde_json::Value> {
    let browser = ["chromium", "chromium-browser", "google-chrome"]
        .into_iter()
        .find(|name| Command::new(name).arg("--version").output().is_ok_and(|output| output.status.success()))?;
    let folder = tempfile::tempdir().unwrap();
    let watch = "<script>var problems = []; addEventListener('error', (event) => problems.push(event.message));
        addEventListener('securitypolicyviolation', (event) => problems.push(event.violatedDirective));
        for (const name of ['error', 'warn']) console[name] = (...words) => problems.push(words.join(' '));</script>";
    let page = page.replacen("<head>", &format!("<head>{watch}"), 1);
    // A window is never as narrow as a phone, a frame is.
    let escaped = page.replace('&', "&amp;").replace('"', "&quot;");
    let frames = widths.map(|width| {
        format!(
            "<iframe id=\"w{width}\" style=\"width:{width}px;height:800px;border:0\" srcdoc=\"{escaped}\"></iframe>"
        )
    });
    let around = format!(
        "<!DOCTYPE html><meta charset=\"utf-8\"><title>check</title>{2}<pre id=\"found\"></pre><script>
         const check = {CHECK};
         addEventListener('load', () => {{
           let found;
           try {{ found = {{ 'w{0}': check({0}), 'w{1}': check({1}) }}; }} catch (error) {{ found = {{ failed: String(error.stack) }}; }}
           document.getElementById('found').textContent = btoa(unescape(encodeURIComponent(JSON.stringify(found))));
         }});</script>",
        widths[0],
        widths[1],
        frames.concat(),
    );
    let path = folder.path().join("check.html");
    std::fs::write(&path, around).unwrap();
    let output = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", "--window-size=1400,900"])
        .arg(format!("--user-data-dir={}", folder.path().join("profile").display()))
        .args(["--virtual-time-budget=10000", "--dump-dom"])
        .arg(&path)
        .output()
        .unwrap();
    let talk = said(&output);
    let console: Vec<&str> = talk.lines().filter(|line| line.contains("CONSOLE")).take(5).collect();
    assert!(console.is_empty(), "the console says {console:?}");
    let dom = String::from_utf8_lossy(&output.stdout);
    let found = dom.split("<pre id=\"found\">").nth(1).and_then(|rest| rest.split('<').next());
    let found = found.unwrap_or_else(|| panic!("{browser} found nothing: {talk}"));
    let json = BASE64_STANDARD.decode(found).unwrap_or_else(|_| panic!("{browser}: {talk}"));
    Some(serde_json::from_slice(&json).unwrap())
}

/// Leaves a report in `target/tmp` for inspection.
fn keep(name: &str, rows: &[Row]) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&folder).unwrap();
    write(&folder, rows, &info()).unwrap();
}

#[test]
fn the_page_sorts_and_chooses_and_fits_phones_and_screens() {
    let widths = [360, 1400];
    let rows = made_up_rows("a machine with a rather long name, x86_64, 2 threads", 1.0);
    keep("report", &rows);
    let Some(found) = in_browser(&html(&rows, &info()).unwrap(), widths) else {
        return skip("the page in a browser: no chromium; on Debian: apt-get install chromium");
    };
    assert!(found["failed"].is_null(), "{}", found["failed"]);
    let count = format!("4 of {} rows", rows.len());
    let with_lines = rows.iter().filter(|row| row.lines.is_some()).count();
    for width in widths {
        let found = &found[format!("w{width}")];
        assert_eq!(found["problems"], serde_json::json!([]));
        assert_eq!(found["inner"], width);
        assert_eq!(found["wider"], serde_json::json!([]), "at {width}");
        assert_eq!(found["brokenWords"], serde_json::json!([]), "at {width}");
        for scroll in ["scroll", "scrollAfter"] {
            assert!(found[scroll].as_u64().unwrap() <= width.into(), "{scroll} {} at {width}", found[scroll]);
        }
        assert!(found["smallestText"].as_f64().unwrap() > 10.0, "{} at {width}", found["smallestText"]);
        assert_eq!((found["rows"].as_u64(), found["plots"].as_u64()), (Some(rows.len() as u64), Some(3)));
        assert!(found["allHeaders"].as_u64() > found["headers"].as_u64());
        for (column, with_value) in [("time", rows.len()), ("f1", with_lines)] {
            for (press, state) in ["ascending", "descending"].into_iter().enumerate() {
                let sorted = &found[column][press];
                assert_eq!(sorted["state"], state);
                let texts: Vec<&str> =
                    sorted["values"].as_array().unwrap().iter().map(|text| text.as_str().unwrap()).collect();
                let numbers: Vec<f64> = texts.iter().take(with_value).map(|text| text.parse().unwrap()).collect();
                let is_sorted = if press == 0 { numbers.is_sorted() } else { numbers.iter().rev().is_sorted() };
                assert!(is_sorted, "{column} {state}: {numbers:?}");
                assert!(texts[with_value..].iter().all(|text| text.is_empty()), "what is missing comes last");
            }
        }
        assert_eq!(found["model"][0]["values"][0], "builtin:bust");
        assert_eq!(found["model"][1]["values"][0], "stanford-bunny.obj", "the folder is named once, below");
        assert_eq!(found["chosenRows"], serde_json::json!(vec!["fandisk.obj inking"; 4]));
        assert_eq!(found["chosenPlots"], serde_json::json!(vec!["fandisk.obj"; 3]));
        let pictures = found["chosenPictures"].as_u64();
        assert_eq!((pictures, found["count"].as_str()), (Some(2), Some(&*count)), "a drawing and its errors");
    }
}

#[test]
fn the_page_of_two_machines_fits_and_shows_the_plots_of_each() {
    let mut rows = made_up_rows("this machine, linux x86_64, 2 threads", 1.0);
    rows.extend(made_up_rows("another_machine_whose_name_has_no_space_to_break_at_and_goes_on", 0.61));
    keep("report-machines", &rows);
    let Some(found) = in_browser(&html(&rows, &info()).unwrap(), [360, 1280]) else {
        return skip("the page of two machines in a browser: no chromium; on Debian: apt-get install chromium");
    };
    assert!(found["failed"].is_null(), "{}", found["failed"]);
    for width in [360, 1280] {
        let found = &found[format!("w{width}")];
        assert_eq!(
            (&found["problems"], &found["wider"]),
            (&serde_json::json!([]), &serde_json::json!([])),
            "at {width}"
        );
        assert!(found["scroll"].as_u64().unwrap() <= width, "{} at {width}", found["scroll"]);
        assert_eq!((found["plots"].as_u64(), found["rows"].as_u64()), (Some(6), Some(rows.len() as u64)));
    }
}
