use flexura_mechanics::rod::*;
use std::time::Instant;
fn go<const W: usize>(name:&str, p:&Piece){
    let n=20000; let mut acc=0.0;
    let t=Instant::now();
    for i in 0..n { let mut s: RodState<W>=RodState::origin(); s.force=[0.1,1.0+1e-6*i as f64,0.2]; s.moment=[0.1,0.2,1.0];
        if W>1 {for j in 0..3 {if j+1<W {s.d[9+j][1+j]=1.0;}}}
        advance(p,1.0,&mut s); acc+=s.position[0]+s.d[0][W-1]; }
    println!("{name} W={W}: {:.0} ns/step (acc {acc:.3})", t.elapsed().as_nanos() as f64/(n as f64*p.steps as f64));
}
fn main(){
    let l=LawTable::Slender(vec![Slender{k0:[0.0;3],stretch:0.0,bend:[1.3,1.0,1.0]}]);
    let p=Piece{length:1.0,steps:4,laws:l.clone(),loads:vec![]};
    go::<1>("free",&p);go::<4>("free",&p);go::<8>("free",&p);go::<12>("free",&p);go::<16>("free",&p);
    let p=Piece{length:1.0,steps:4,laws:l,loads:vec![LoadSample::default()]};
    go::<1>("load",&p);go::<4>("load",&p);go::<8>("load",&p);go::<16>("load",&p);
    let l=LawTable::Shearable(vec![Shearable{k0:[0.0;3],shear:[0.01;3],bend:[1.3,1.0,1.0]}]);
    let p=Piece{length:1.0,steps:4,laws:l,loads:vec![]};
    go::<1>("shear",&p);go::<4>("shear",&p);go::<8>("shear",&p);
}
