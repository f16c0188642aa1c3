use super::*;

/// A chain whose states grow by 1e3 a segment in half the directions and decay in the other half.
fn blocks(count: usize) -> Vec<Block> {
    (0..count)
        .map(|k| {
            let mut b = [[0.0; BLOCK]; BLOCK];
            for i in 0..BLOCK {
                for j in 0..BLOCK {
                    b[i][j] = 0.1 * ((7 * i + 3 * j + 5 * k) as f64).sin();
                }
                b[i][i] += if i < BLOCK / 2 { 1e3 } else { 1e-3 };
            }
            b
        })
        .collect()
}

fn times(b: &Block, x: &[f64; BLOCK]) -> [f64; BLOCK] {
    std::array::from_fn(|i| (0..BLOCK).map(|j| b[i][j] * x[j]).sum())
}

/// With decaying parts known at the head and growing parts known at the tail the problem is well posed; plain
/// recursion would lose everything after six segments of growth 1e3.
#[test]
fn gives_back_the_states_of_a_long_stiff_chain() {
    let count = 40;
    let b = blocks(count);
    let head: Vec<Vec<f64>> = (0..BLOCK)
        .map(|i| (0..6).map(|j| if i == j { 1.0 } else { 0.2 / (1 + i + j) as f64 }).collect())
        .collect();
    // Any states will do: the gaps are made to fit.
    let u: Vec<f64> = (0..6).map(|j| (j as f64 - 2.0) * 0.3).collect();
    let x: Vec<[f64; BLOCK]> =
        (0..=count).map(|k| std::array::from_fn(|i| ((k * 13 + i * 7) as f64).cos())).collect();
    let mut gaps =
        vec![std::array::from_fn(|i| x[0][i] - head[i].iter().zip(&u).map(|(h, u)| h * u).sum::<f64>())];
    for k in 0..count {
        let moved = times(&b[k], &x[k]);
        gaps.push(std::array::from_fn(|i| x[k + 1][i] - moved[i]));
    }
    let mut chain = Chain::default();
    chain.start(&head);
    for block in &b {
        chain.extend(block).unwrap();
    }
    let known = chain.reduce(&gaps);
    for i in 0..BLOCK {
        let left: f64 = chain.left_head[i].iter().zip(&u).map(|(p, u)| p * u).sum::<f64>()
            + chain.left_state[i].iter().zip(&x[count]).map(|(q, x)| q * x).sum::<f64>();
        assert!(
            (left - known[i]).abs() < 1e-9 * (1.0 + known[i].abs()),
            "row {i}: {left} against {}",
            known[i]
        );
    }
    let mut states = vec![[0.0; BLOCK]; chain.eliminated()];
    chain.back_substitute(&u, &x[count], &mut states);
    for k in 0..count {
        for i in 0..BLOCK {
            assert!((states[k][i] - x[k][i]).abs() < 1e-9, "state {k}, component {i}");
        }
    }
}
