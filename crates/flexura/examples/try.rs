//! x
use flexura::model::Curve;
use std::time::Instant;
fn main() {
    let file = std::env::args().nth(1).unwrap();
    let doc = flexura::modelfile::Document::read(&file).unwrap();
    let mut model = doc.model(&[]).unwrap();
    let mut p = flexura::Prepared::new(&model).unwrap();
    p.solve(1e-6, &mut |_| {});
    for _ in 0..3 {
        let t = Instant::now();
        for _ in 0..1000 {
            let l = p.problem().neighbour(&model).unwrap();
            std::hint::black_box(&l);
        }
        println!("neighbour {:?}", t.elapsed() / 1000);
        let t = Instant::now();
        for _ in 0..1000 {
            std::hint::black_box(model.clone());
        }
        println!("clone {:?}", t.elapsed() / 1000);
        let t = Instant::now();
        for _ in 0..1000 {
            p.linearise().unwrap();
        }
        println!("linearise {:?}", t.elapsed() / 1000);
        let t = Instant::now();
        for _ in 0..1000 {
            p.problem().residual_size();
        }
        println!("residual {:?}", t.elapsed() / 1000);
        let c0 = p.problem().counts();
        let t = Instant::now();
        for i in 0..1000 {
            for b in 0..6 {
                model.beams[b].curve =
                    Curve::Straight { length: 0.5 + 0.001 * ((i % 2) as f64) * (1.0 + 0.1 * b as f64) };
            }
            p.adopt(&model).unwrap();
            p.solve_from_here(1e-6, &mut |_| {});
        }
        println!("step {:?}", t.elapsed() / 1000);
        println!(
            "{:?} {:?} {} {}",
            c0,
            p.problem().counts(),
            p.problem().integration_steps(),
            p.problem().segments()
        );
    }
}
