//! The error estimate is honest: the true error is within ten times of it, and it is within the tolerance.

use flexura_verification::{Estimate, cases, find};

fn check(id: &str) {
    let case = find(id).unwrap_or_else(|| panic!("no case {id}"));
    let weigh = case.closed_form.unwrap_or_else(|| panic!("{id} has no closed form"));
    let (mut report, mut honest) = (String::new(), true);
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
        let found = weigh(tolerance).unwrap_or_else(|error| panic!("{id}: {error}"));
        assert!(!found.is_empty(), "{id} weighs nothing");
        for Estimate { what, error, estimate } in &found {
            report += &format!("{tolerance:.0e} {what}: error {error:.1e}, estimate {estimate:.1e}\n");
        }
        honest &= found.iter().all(|estimate| estimate.is_honest(tolerance));
    }
    assert!(honest, "{id}:\n{report}");
}

macro_rules! honest {
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

honest!(
    elastica,
    roll_up,
    follower_planar,
    follower_spatial,
    ellipse,
    helix,
    space_curve,
    helix_by_wrench,
    strip_50_g,
    tendon_arc,
    tendon_helix
);

#[test]
fn every_closed_form_is_held_against_the_estimate() {
    let ids: Vec<&str> =
        cases().iter().filter(|case| case.closed_form.is_some()).map(|case| case.id).collect();
    assert_eq!(ids, TESTED);
}
