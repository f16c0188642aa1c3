//! The cases, one file for each group.

mod bend45;
mod clamped_clamped;
mod columns;
mod contact;
mod curves;
mod damping;
mod deep_arch;
mod elastica;
mod ends;
mod flexure_order;
mod flexures;
mod flutter;
mod follower;
mod foundation;
mod four_bar;
mod frame;
mod half_ring;
mod helix_wrench;
mod joints;
mod lee_frame;
mod ligaments;
mod modes;
mod modes_curved;
mod modes_of_mechanisms;
mod motion;
mod node;
mod node_models;
mod pushed_strip;
pub(crate) mod recipe;
mod robot;
mod roll_up;
mod rolling;
mod sideways;
mod slide_law;
mod snaps;
mod spinning;
mod spring;
mod state_space;
mod strip;
mod taper;
mod tendons;
mod torsion;
mod tubes;
mod unfolding;
mod verdicts;

use crate::Case;

/// All cases, in the order of the table.
pub fn cases() -> Vec<Case> {
    [
        &elastica::CASES[..],
        &roll_up::CASES,
        &follower::CASES,
        &bend45::CASES,
        &curves::CASES,
        &helix_wrench::CASES,
        &spring::CASES,
        &half_ring::CASES,
        &strip::CASES,
        &recipe::CASES,
        &taper::CASES,
        &clamped_clamped::CASES,
        &four_bar::CASES,
        &robot::CASES,
        &ends::CASES,
        &deep_arch::CASES,
        &frame::CASES,
        &flexure_order::CASES,
        &flexures::CASES,
        &joints::CASES,
        &ligaments::CASES,
        &tendons::CASES,
        &tubes::CASES,
        &columns::CASES,
        &foundation::CASES,
        &pushed_strip::CASES,
        &slide_law::CASES,
        &node::CASES,
        &node_models::CASES,
        &torsion::CASES,
        &sideways::CASES,
        &snaps::CASES,
        &lee_frame::CASES,
        &unfolding::CASES,
        &verdicts::CASES,
        &modes::CASES,
        &modes_curved::CASES,
        &modes_of_mechanisms::CASES,
        &state_space::CASES,
        &flutter::CASES,
        &damping::CASES,
        &spinning::CASES,
        &motion::CASES,
        &rolling::CASES,
        &contact::CASES,
    ]
    .concat()
}

/// The case of that id.
pub fn find(id: &str) -> Option<Case> {
    cases().into_iter().find(|case| case.id == id)
}
