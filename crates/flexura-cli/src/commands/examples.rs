//! `flexura examples [NAME]`

use crate::arguments::ExamplesArguments;
use crate::failure::Failure;
use crate::table::Table;
use crate::{files, screen};
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
    "universal_shaft",
    "lightest_cantilever",
    "thinnest_clamp",
    "bistable_design",
    "robot_tilt",
];

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
    if !is_forced && Path::new(&path).symlink_metadata().is_ok() {
        return Err(Failure::Input(format!(
            "{path} is there already and is left as it is; --force overwrites it"
        )));
    }
    files::replace(Path::new(&path), text)?;
    screen::note(&format!("wrote {path}; try: flexura solve {path}"));
    Ok(())
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
    fn every_bundled_model_starts_with_a_title() {
        for (name, text) in MODELS {
            assert!(text.starts_with("# ") && title(text).len() > 10, "{name}");
        }
    }
}
