//! One test for each case: no row may exceed its tolerance.

use flexura_verification::{Row, cases, find};

/// Runs a case; a failure shows all its rows.
fn check(id: &str) {
    let case = find(id).unwrap_or_else(|| panic!("no case {id}"));
    let rows = (case.run)().unwrap_or_else(|error| panic!("{id}: {error}"));
    assert!(!rows.is_empty(), "{id} compares nothing");
    let show = |row: &Row| {
        let mark = if row.passes() { "" } else { "  <-- FAILS" };
        let estimate = row.estimate.map_or("none".to_string(), |estimate| format!("{estimate:.1e}"));
        format!(
            "{}: reference {:.13e}, ours {:.13e}, difference {:.1e}, allowed {:.0e}, estimate {estimate}{mark}\n",
            row.quantity, row.reference, row.ours, row.difference, row.tolerance,
        )
    };
    let report: String = rows.iter().map(show).collect();
    assert!(rows.iter().all(Row::passes), "{id}:\n{report}");
}

macro_rules! conforms {
    ($($id:ident),* $(,)?) => {
        $(
            #[test]
            fn $id() {
                check(stringify!($id));
            }
        )*

        const TESTED: &[&str] = &[$(stringify!($id)),*];
    };
}

conforms!(
    elastica,
    elastica_mattiasson,
    elastica_push,
    roll_up,
    follower_planar,
    follower_spatial,
    bend_45_polar,
    bend_45,
    ellipse,
    helix,
    space_curve,
    helix_by_wrench,
    spring_small_load,
    spring_wahl,
    spring_bows,
    half_ring,
    strip_50_g,
    recipe,
    tapered_beam,
    clamped_clamped,
    four_bar_balance,
    four_bar,
    six_rod_robot,
    ends_cantilever,
    ends_clamped,
    ends_pinned,
    ends_slide_fixed,
    ends_slide_offset_pin,
    deep_arch,
    deep_arch_fold,
    right_angle_frame,
    parallelogram_small,
    cross_spring_small,
    leaf_four_bar_small,
    cartwheel_small,
    bistable_small,
    parallelogram_far,
    cross_spring_far,
    leaf_four_bar_far,
    cartwheel_far,
    bistable_far,
    couplings,
    universal_joint,
    rigid_four_bar,
    bushings,
    string_polygon,
    hinged_beams,
    limits_and_rests,
    ligament_projection,
    ligament_geometry,
    ligament_size,
    wrapped_paths,
    wrapped_lever,
    tendon_arc,
    tendon_helix,
    tendon_robot,
    two_tubes,
    one_tube,
    euler_columns,
    euler_post_buckled,
    foundation_cantilever,
    foundation_column,
    foundation_bend,
    pushed_strip,
    sensor_strip,
    sensor_strip_printed,
    sensor_strip_variants,
    slide_law,
    node_corner,
    node_camera_printed,
    portal_frame,
    node_models,
    node_balance,
    hockling_shaft,
    greenhill_shaft,
    michell_ring,
    lateral_strip,
    frame_end_moments,
    shallow_arch,
    shallow_arch_sway,
    bistable_folds,
    lee_frame,
    unfolded_pitchfork,
    fold_curves,
    crossing_slope,
    stability_by_motion,
    undecided_stability,
    modes_of_beams,
    modes_of_timoshenko_beams,
    modes_of_bars,
    modes_of_columns,
    modes_of_tapered_beams,
    modes_of_arcs,
    modes_of_springs,
    modes_about_loads,
    modes_of_buckled_strips,
    modes_of_flexures,
    modes_of_a_platform,
    modes_with_tendons,
    state_space,
    modes_without_energy,
    flutter_loads,
    damped_modes,
    onset_of_flutter,
    spinning_shapes,
    spinning_modes,
    knee_leg,
    knee_exoskeleton,
    four_bar_motion,
    ellipse_on_circle,
    ellipse_sliding,
    ellipse_on_ellipse,
    ellipse_in_bowl,
    explicit_recipe,
    knee_slide,
    rolling_beam,
    rolling_ellipsoids,
);

#[test]
fn every_case_has_a_test() {
    let ids: Vec<&str> = cases().iter().map(|case| case.id).collect();
    assert_eq!(ids, TESTED);
}
