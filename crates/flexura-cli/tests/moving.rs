//! Studies of the kind `inverse_dynamics` as the command does them.

// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

mod common;

use common::{code, folder, run, stderr, stdout};

#[test]
fn a_motion_is_summarised_and_written() {
    let folder = folder("a_motion_is_summarised");
    let output = run(&["run", "knee_leg.toml", "flexion", "-o", folder.to_str().unwrap()]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = stdout(&output);
    for words in ["lower leg: converged", "in 2 s, 403 times", "f_theta", "knee   -9.0494 N·m", "peak power"]
    {
        assert!(text.contains(words), "{words}: {text}");
    }
    assert!(
        stderr(&output).contains("wrote result.json, motion.csv, motion.svg and report.html"),
        "{}",
        stderr(&output)
    );
    let folder = folder.join("flexion");
    let table = std::fs::read_to_string(folder.join("motion.csv")).unwrap();
    let first = "time [s],theta [rad],rate [rad/s],acceleration [rad/s^2],r [m],f_r [N],f_theta [N],tau_a [N*m],\
                 knee.coordinate [rad],knee.velocity [rad/s],knee.effort [N*m],\
                 shift.coordinate [m],shift.velocity [m/s],shift.effort [N],drive_power [W],kinetic_energy [J],reason";
    assert_eq!(table.lines().next().unwrap(), first);
    assert_eq!(table.lines().count(), 404);
    let result: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(folder.join("result.json")).unwrap()).unwrap();
    assert_eq!(result["study"], "inverse_dynamics");
    for list in [
        &result["times"],
        &result["outputs"]["f_r"],
        &result["bodies"]["leg"]["velocity"],
        &result["joints"]["knee"]["efforts"],
        &result["drive_power"],
    ] {
        assert_eq!(list.as_array().unwrap().len(), 403);
    }
    let picture = std::fs::read_to_string(folder.join("motion.svg")).unwrap();
    assert!(picture.contains("rate of theta / °/s") && picture.contains("force / N"), "{picture}");
}

/// A study that does not fit its model is an input error at its own table.
#[test]
fn a_motion_that_moves_nothing_is_shown_at_its_table() {
    let folder = folder("a_motion_that_moves_nothing");
    let text = std::fs::read_to_string(common::models().join("knee_leg.toml")).unwrap();
    let path = folder.join("still.toml");
    std::fs::write(
        &path,
        text.replace("coordinate = \"theta\"", "coordinate = \"0.1 rad\"")
            .replace("\"radius\"", "\"0.26 m\""),
    )
    .unwrap();
    let output = run(&["run", path.to_str().unwrap(), "flexion"]);
    assert_eq!(code(&output), 2, "{}", stdout(&output));
    for words in ["`theta` moves nothing", "[study.flexion]", "coordinate = \"theta\""] {
        assert!(stderr(&output).contains(words), "{words}: {}", stderr(&output));
    }
}

/// A time at which the links lie in one line has no result; what was found before it is kept.
#[test]
fn a_time_in_the_singular_position_ends_the_motion() {
    let folder = folder("a_time_in_the_singular_position");
    let text = std::fs::read_to_string(common::models().join("knee_exoskeleton.toml")).unwrap();
    let path = folder.join("singular.toml");
    std::fs::write(&path, text.replace("samples = 101", "step = \"5 ms\"")).unwrap();
    let output = run(&["run", path.to_str().unwrap(), "flexion", "--json"]);
    assert_eq!(code(&output), 1, "{}", stderr(&output));
    assert!(stderr(&output).contains("singular position"), "{}", stderr(&output));
    let result: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    let times = result["times"].as_array().unwrap();
    assert_eq!(times.len(), 50, "{times:?}");
    assert!(result["reason"].as_str().unwrap().contains("t = 0.25 s"), "{}", result["reason"]);
}
