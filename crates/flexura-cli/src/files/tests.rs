// Clippy takes helpers of tests for code that must not panic.
#![allow(clippy::unwrap_used)]

use super::*;

/// An empty folder of that name.
fn folder(name: &str) -> PathBuf {
    let path = std::env::temp_dir().join(format!("flexura-files-{name}-{}", std::process::id()));
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

fn document(files: &[&str]) -> String {
    serde_json::json!({ "flexura": "0", "study": "solve", "files": files }).to_string()
}

#[test]
fn files_of_an_earlier_study_go_and_those_of_the_user_stay() {
    let folder = folder("earlier");
    let files = |names: &[&'static str]| -> Vec<(&'static str, String)> {
        names.iter().map(|name| (*name, (*name).to_owned())).collect()
    };
    for mine in ["modes.csv", "notes.txt", "path.csv.txt"] {
        fs::write(folder.join(mine), "mine").unwrap();
    }
    let trace = ["path.csv", "critical.csv", "diagram.svg", "shapes.svg"];
    replace_all(&folder, &document(&trace), &files(&trace)).unwrap();
    let buckle = ["shapes.svg"];
    replace_all(&folder, &document(&buckle), &files(&buckle)).unwrap();
    assert_eq!(names(&folder), ["modes.csv", "notes.txt", "path.csv.txt", "result.json", "shapes.svg"]);
    // A document that claims more than flexura writes is not believed.
    fs::write(folder.join(RESULT), document(&["notes.txt", "../x", "shapes.svg"])).unwrap();
    replace_all(&folder, &document(&[]), &[]).unwrap();
    assert_eq!(names(&folder), ["modes.csv", "notes.txt", "path.csv.txt", "result.json"]);
    // Of a document that is none nothing is known.
    fs::write(folder.join(RESULT), "{ \"files\": [\"modes.csv\"] }").unwrap();
    replace_all(&folder, &document(&[]), &[]).unwrap();
    assert!(folder.join("modes.csv").is_file());
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn when_one_file_cannot_be_written_all_stay_as_they_were() {
    let folder = folder("one_of_them");
    let old = document(&["beams.csv"]);
    let files = |text: &str| [("beams.csv", text.to_owned()), ("shape.svg", text.to_owned())];
    replace_all(&folder, &old, &files("old")).unwrap();
    // A folder stands where the document belongs.
    fs::rename(folder.join(RESULT), folder.join("kept.json")).unwrap();
    fs::create_dir(folder.join(RESULT)).unwrap();
    let failure = replace_all(&folder, &document(&[]), &files("new")).unwrap_err();
    assert!(matches!(&failure, Failure::Machine(message) if message.contains(RESULT)), "{failure}");
    assert_eq!(fs::read_to_string(folder.join("beams.csv")).unwrap(), "old");
    assert_eq!(names(&folder), ["beams.csv", "kept.json", "result.json", "shape.svg"]);
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_table_grows_beside_its_place() {
    let folder = folder("growing");
    let path = folder.join("table.csv");
    fs::write(&path, "old").unwrap();
    let mut growing = Growing::begin(&path, "a,b\n").unwrap();
    growing.add("1,2\n");
    assert_eq!(fs::read_to_string(folder.join("table.csv.partial")).unwrap(), "a,b\n1,2\n");
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    growing.finish();
    assert_eq!(names(&folder), ["table.csv"]);
    assert!(Growing::begin(&folder, "a\n").is_err() && Growing::begin(&folder.join("no/t.csv"), "").is_err());
    fs::remove_dir_all(folder).unwrap();
}

#[cfg(unix)]
#[test]
fn links_and_permissions_stay() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = folder("links");
    let (real, link) = (folder.join("real.csv"), folder.join("link.csv"));
    fs::write(&real, "old").unwrap();
    fs::set_permissions(&real, fs::Permissions::from_mode(0o640)).unwrap();
    symlink(&real, &link).unwrap();
    replace(&link, "new").unwrap();
    assert!(link.is_symlink());
    assert_eq!(fs::read_to_string(&real).unwrap(), "new");
    assert_eq!(fs::metadata(&real).unwrap().permissions().mode() & 0o777, 0o640);
    fs::set_permissions(&real, fs::Permissions::from_mode(0o440)).unwrap();
    let failure = replace(&link, "newer").unwrap_err();
    assert!(failure.to_string().contains("read-only"), "{failure}");
    assert_eq!(names(&folder), ["link.csv", "real.csv"]);
    fs::remove_dir_all(folder).unwrap();
}

/// `/dev/full` takes nothing, as a full disk does; and it must still be there afterwards.
#[cfg(target_os = "linux")]
#[test]
fn a_device_is_written_to_and_never_exchanged() {
    let full = Path::new("/dev/full");
    let failure = replace(full, "text").unwrap_err();
    assert!(matches!(&failure, Failure::Machine(message) if message.contains("/dev/full")), "{failure}");
    assert!(!fs::metadata(full).unwrap().is_file());
    replace(Path::new("/dev/null"), "text").unwrap();
    assert!(!fs::metadata("/dev/null").unwrap().is_file());
    let mut growing = Growing::begin(Path::new("/dev/null"), "a\n").unwrap();
    growing.add("1\n");
    growing.finish();
    assert!(!Path::new("/dev/null.partial").exists());
}
