use flexura_mechanics::rod::*;
fn go<const W: usize>(n:usize){
    let p=Piece{length:1.0,steps:4,laws:LawTable::Slender(vec![Slender{k0:[0.0;3],stretch:0.0,bend:[1.3,1.0,1.0]}]),loads:vec![]};
    let mut acc=0.0;
    for i in 0..n { let mut s: RodState<W>=RodState::origin(); s.force=[0.1,1.0+1e-6*i as f64,0.2]; s.moment=[0.1,0.2,1.0];
        if W>1 {for j in 0..3 {s.d[9+j][1+j]=1.0;}}
        advance(&p,1.0,&mut s); acc+=s.position[0]+s.d[0][W-1]; }
    println!("{acc}");
}
fn main(){ match std::env::args().nth(1).unwrap().as_str() {"1"=>go::<1>(100000),"4"=>go::<4>(100000),"8"=>go::<8>(100000),"16"=>go::<16>(100000),_=>{}} }
