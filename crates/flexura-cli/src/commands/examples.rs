//! `flexura examples [NAME]`

use crate::arguments::ExamplesArguments;
use crate::failure::Failure;
use crate::table::Table;
use crate::{files, screen};
use flexura::modelfile::Document;
use std::path::Path;

macro_rules! bundled {
    ($($name:literal),* $(,)?) => {
        [$(($name, include_str!(concat!("../../../../models/", $name, ".toml")))),*]
    };
}

/// The bundled models: name and text.
const MODELS: &[(&str, &str)] = &bundled![
    "cantilever_strip",
    "elastica",
    "roll_up",
    "follower_cantilever",
    "tapered_beam",
    "bend_45",
    "curved_hook",
    "compression_spring",
    "half_ring",
    "parallelogram_stage",
    "four_bar",
    "sensor_clamp",
    "tendon_robot",
    "concentric_tubes",
    "condyle_tendon",
    "ellipse_on_circle",
    "ellipse_sliding",
    "ellipse_on_ellipse",
    "ellipse_in_bowl",
    "explicit_recipe",
    "knee_circles",
    "knee_ellipse",
    "knee_ellipses",
    "wheel_on_slope",
    "rolling_beam",
    "cam_follower",
    "clearance_pin",
    "coracoid_keel",
    "wing",
    "egg",
    "measured_condyle",
    "ellipsoid_in_dish",
    "wing_ligaments",
    "bistable_beam",
    "lee_frame",
    "shallow_arch",
    "strip_on_slope",
    "cable_polygon",
    "cartwheel_hinge",
    "cross_spring_pivot",
    "deep_arch",
    "clavicle",
    "bone_bending",
    "column_on_foundation",
    "pendulum",
    "ends_cantilever",
    "ends_clamped",
    "ends_pinned",
    "ends_slide_fixed",
    "ends_slide_offset_pin",
    "euler_clamped_clamped",
    "euler_clamped_free",
    "euler_clamped_pinned",
    "euler_pinned_pinned",
    "frame_end_moments",
    "greenhill_shaft",
    "hinged_beams",
    "hockling_shaft",
    "knee_exoskeleton",
    "knee_leg",
    "lateral_strip",
    "lattice",
    "lattice_3d",
    "leaf_four_bar",
    "michell_ring",
    "rack_and_pinion",
    "redundant_welds",
    "right_angle_frame",
    "rigid_four_bar",
    "six_rod_robot",
    "tuning_fork",
    "cross_spring_oscillator",
    "guide_frequencies",
    "coil_spring_modes",
    "sagging_strip",
    "universal_shaft",
    "beck_column",
    "ziegler_pendulum",
    "spinning_arm",
    "lightest_cantilever",
    "thinnest_clamp",
    "bistable_design",
    "robot_tilt",
    "node_sensor",
    "node_corner",
    "node_corner_together",
    "node_corner_rear",
    "node_narrow_corner",
    "node_laminate",
    "node_camera",
    "node_camera_aim",
    "node_camera_formula",
    "node_camera_printed",
    "portal_frame",
    "shoulder_joint",
];

/// What models share by `include`: name and text.
const PARTS: &[(&str, &str)] =
    &bundled!["parts/flexonic_node", "parts/flexonic_corner", "parts/flexonic_camera"];

pub fn run(arguments: &ExamplesArguments) -> Result<(), Failure> {
    match &arguments.name {
        None => list(),
        Some(name) => write(name.trim_end_matches(".toml"), arguments.force),
    }
}

fn list() -> Result<(), Failure> {
    let mut table = Table::new(&["bundled models"]);
    for (name, text) in MODELS {
        table.row(vec![(*name).to_owned(), title(text).to_owned()]);
    }
    screen::print(&format!(
        "{}\n`flexura examples NAME` writes one into the current folder.\n",
        table.render()
    ))
}

/// The first line of a model file's leading comment.
fn title(text: &str) -> &str {
    text.lines().next().unwrap_or_default().trim_start_matches('#').trim()
}

fn write(name: &str, is_forced: bool) -> Result<(), Failure> {
    let Some((_, text)) = MODELS.iter().find(|(bundled, _)| *bundled == name) else {
        let names = MODELS.iter().map(|(bundled, _)| *bundled);
        let hint = match flexura::expression::nearest(name, names) {
            Some(near) => format!("did you mean `{near}`?"),
            None => "`flexura examples` lists them".to_owned(),
        };
        return Err(Failure::Input(format!("there is no bundled model `{name}`; {hint}")));
    };
    let path = format!("{name}.toml");
    let parts = parts(&path, text)?;
    let is_there = |path: &str| Path::new(path).symlink_metadata().is_ok();
    // A part that another example brought is the same one.
    let is_other = |(part, text): &&(String, &str)| {
        is_there(part) && std::fs::read_to_string(part).is_ok_and(|present| present != *text)
    };
    let in_the_way = is_there(&path).then_some(path.as_str());
    let in_the_way = in_the_way.or_else(|| parts.iter().find(is_other).map(|(part, _)| part.as_str()));
    if let (Some(path), false) = (in_the_way, is_forced) {
        return Err(Failure::Input(format!(
            "{path} is there already and is left as it is; --force overwrites it"
        )));
    }
    for (part, text) in &parts {
        if let Some(folder) = Path::new(part).parent().filter(|folder| !folder.as_os_str().is_empty()) {
            files::make_folder(folder)?;
        }
        files::replace(Path::new(part), text)?;
    }
    files::replace(Path::new(&path), text)?;
    let with = match parts.as_slice() {
        [] => String::new(),
        parts => {
            let names: Vec<&str> = parts.iter().map(|(part, _)| part.as_str()).collect();
            format!(" with {}, which it includes", names.join(" and "))
        }
    };
    screen::note(&format!("wrote {path}{with}; try: flexura solve {path}"));
    Ok(())
}

/// The bundled files that a bundled model includes, with their paths.
fn parts(path: &str, text: &str) -> Result<Vec<(String, &'static str)>, Failure> {
    let files: Vec<(String, &'static str)> =
        MODELS.iter().chain(PARTS).map(|(name, text)| (format!("{name}.toml"), *text)).collect();
    let held: Vec<(&str, &str)> = files.iter().map(|(path, text)| (path.as_str(), *text)).collect();
    let document =
        Document::parse_with(text, path, &held).map_err(|report| Failure::Input(report.render(false)))?;
    let included: Vec<&str> = document.included().collect();
    Ok(files.into_iter().filter(|(path, _)| included.contains(&path.as_str())).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_in_models_is_bundled_under_its_name() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models");
        let mut on_disk: Vec<String> = std::fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().path())
            .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
            .map(|path| path.file_stem().unwrap().to_string_lossy().into_owned())
            .collect();
        let mut bundled: Vec<String> = MODELS.iter().map(|(name, _)| (*name).to_owned()).collect();
        on_disk.sort();
        bundled.sort();
        assert_eq!(bundled, on_disk);
    }

    #[test]
    fn every_bundled_model_finds_the_parts_that_it_includes() {
        for (name, text) in MODELS {
            let parts = parts(&format!("{name}.toml"), text).unwrap_or_else(|_| panic!("{name}"));
            assert_eq!(parts.is_empty(), !text.lines().any(|line| line.starts_with("include")), "{name}");
        }
    }

    #[test]
    fn every_bundled_model_starts_with_a_title() {
        for (name, text) in MODELS {
            assert!(text.starts_with("# ") && title(text).len() > 10, "{name}");
        }
    }
}
