//! x
use std::time::Instant;
fn main() {
    let file = std::env::args().nth(1).unwrap();
    let doc = flexura::modelfile::Document::read(&file).unwrap();
    let t = Instant::now();
    let model = doc.model(&[]).unwrap();
    println!("model {:?}", t.elapsed());
    let t = Instant::now();
    for _ in 0..10 {
        doc.model(&[]).unwrap();
    }
    println!("model x10 {:?}", t.elapsed());
    let t = Instant::now();
    let mut p = flexura::Prepared::new(&model).unwrap();
    println!("prepare {:?}", t.elapsed());
    let t = Instant::now();
    let o = p.solve(1e-6, &mut |_| {});
    println!("solve {:?} {:?} {:?}", t.elapsed(), o.status, o.path);
    println!("{:?}", p.problem().counts());
    let t = Instant::now();
    p.adopt(&model).unwrap();
    println!("adopt {:?}", t.elapsed());
    let t = Instant::now();
    for _ in 0..10 {
        p.problem().sampled(2, false);
    }
    println!("sampled x10 {:?}", t.elapsed());
    use flexura::Equilibrium;
    let _: &mut Equilibrium = p.problem();
    let t = Instant::now();
    for _ in 0..10 {
        p.linearise().unwrap();
    }
    println!("linearise x10 {:?}", t.elapsed());
    let mut family = flexura::FileFamily::new(&doc, &[], &model);
    let t = Instant::now();
    let o = p.solve_inverse_from_here(&mut family, 1e-6);
    println!("inverse {:?} {:?} {:?}", t.elapsed(), o.status, o.path);
    println!("{:?}", p.problem().counts());
}
