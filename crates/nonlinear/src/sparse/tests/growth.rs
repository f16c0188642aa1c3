//! Numbers held and work done, as counted: they do not depend on the machine.

use super::*;

/// Unknowns, fill and operations of a lattice.
fn cost(example: &Example) -> [f64; 3] {
    let mut sparse = example.sparse();
    sparse.factorise().unwrap();
    [example.n as f64, sparse.fill() as f64, sparse.flops() as f64]
}

fn exponent(small: [f64; 3], large: [f64; 3], k: usize) -> f64 {
    (large[k] / small[k]).ln() / (large[0] / small[0]).ln()
}

/// George counts 31/4 m log2 m numbers in a Cholesky factor of a plane lattice of m points and 829/84 m^1.5
/// multiplications. LU of blocks of b holds 2 b^2 as many and takes 4 b^3 operations for one multiplication. Small
/// lattices, which have more rim, need less, so that the exponents come from above. Delayed pivots and the beams'
/// own unknowns add a third to the work of beams.
#[test]
fn on_plane_lattices_fill_grows_like_n_log_n_and_work_like_n_to_three_halves() {
    for example in [lattice, beams] {
        let [small, large] = [24, 72].map(|side| cost(&example([side, side, 1])));
        let per = |c: [f64; 3]| c[1] / (c[0] * c[0].ln());
        assert!(per(large) < 1.35 * per(small));
        assert!(exponent(small, large, 2) < 1.65);
        let points = 72.0_f64 * 72.0;
        assert!(large[1] < 72.0 * 31.0 / 4.0 * points * points.log2());
        assert!(large[2] < 1.5 * 864.0 * 829.0 / 84.0 * points.powf(1.5));
    }
}

#[test]
fn on_chains_fill_and_work_grow_like_n() {
    for example in [lattice, beams] {
        let [small, large] = [500, 4000].map(|side| cost(&example([side, 1, 1])));
        assert!(exponent(small, large, 1) < 1.02);
        assert!(exponent(small, large, 2) < 1.03);
    }
}

#[test]
fn without_places_the_distance_in_the_graph_serves() {
    for example in [lattice([40, 40, 1]), beams([30, 30, 1])] {
        let mut nowhere = example.clone();
        nowhere.blocks.iter_mut().for_each(|block| block.place = [0.0; 3]);
        assert!(cost(&nowhere)[1] < 1.6 * cost(&example)[1]);
        // Places that have nothing to do with the graph.
        let mut numbers = Numbers(4);
        nowhere.blocks.iter_mut().for_each(|block| block.place = std::array::from_fn(|_| numbers.next()));
        assert!(cost(&nowhere)[1] < 1.6 * cost(&example)[1]);
    }
}

#[test]
fn one_block_that_touches_all_others_costs_little() {
    let mut example = lattice([600, 1, 1]);
    let hub = example.n;
    example.blocks.push(BlockPlace { first: hub, count: 6, place: [0.0; 3] });
    example.n += 6;
    for k in 0..hub {
        example.entries.extend([(k, hub + k % 6, 0.1), (hub + k % 6, k, -0.1)]);
    }
    example.entries.extend((0..6).map(|k| (hub + k, hub + k, 1.0)));
    let alone = cost(&lattice([600, 1, 1]));
    assert!(cost(&example)[1] < 2.0 * alone[1]);
}
