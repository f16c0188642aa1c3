#[path="t.rs"] #[allow(dead_code)] mod t;
use flexura_model::*; use flexura_spatial::*; use flexura_study::*; use std::time::Instant;
struct Rng(u64); impl Rng{fn f(&mut self)->f64{ self.0^=self.0<<13; self.0^=self.0>>7; self.0^=self.0<<17; (self.0>>11) as f64/(1u64<<53) as f64}
 fn dir(&mut self)->Vector3<f64>{ loop{ let v=Vector3::new(2.*self.f()-1.,2.*self.f()-1.,2.*self.f()-1.); let n=v.norm(); if n<1.0&&n>0.1 {return v/n;} } } }
fn main(){
  let arg:Vec<f64>=std::env::args().skip(1).map(|a|a.parse().unwrap()).collect();
  let m=t::cantilever(Vector3::zeros(),Vector3::zeros());
  let mut rng=Rng(88172645463325252);
  let loads:Vec<_>=(0..1000).map(|_|{let f=rng.dir()*(10.0*rng.f()); let mm=rng.dir()*rng.f(); (f,mm)}).collect();
  let mut fine=Prepared::new(&m).unwrap();
  fine.path_options().largest_correction=0.01; fine.path_options().largest_contraction=0.02; fine.path_options().point_tolerance=1e-9;
  let mut p=Prepared::new(&m).unwrap();
  if arg.len()>0 {p.path_options().largest_correction=arg[0];} if arg.len()>1 {p.path_options().largest_contraction=arg[1];} if arg.len()>2 {p.path_options().point_tolerance=arg[2];}
  if arg.len()>3 {p.path_options().first_response=arg[3];}
 let tip=|p:&mut Prepared|{ p.problem().tip() };
  let mut refs=vec![]; let mut st=0;
  for (f,mm) in &loads { fine.set_point_load(LoadId(0),*f,*mm); let o=fine.solve(1e-9,&mut |_|{}); if o.status!=flexura_solution::Status::Converged {st+=1; refs.push(None);} else {refs.push(Some(tip(&mut fine)));} }
  let (mut bad,mut failed,mut evals,mut steps)=(0,0,0,0); let mut worst=0f64;
  for ((f,mm),r) in loads.iter().zip(&refs) { p.set_point_load(LoadId(0),*f,*mm); let o=p.solve(1e-6,&mut |_|{}); 
     if let Some(r)=r { if o.status!=flexura_solution::Status::Converged {failed+=1; println!("FAILED {f:?} {mm:?} {o:?}");} else { let e=(tip(&mut p)-r).norm(); if e>1e-4 {bad+=1; if arg.len()>4 { println!("{:?} {:?} |f| {:.2} ours {:?} fine {:?}",f.as_slice(),mm.as_slice(),f.norm(),tip(&mut p).as_slice(),r.as_slice()); fine.path_options().largest_correction=0.002; fine.path_options().point_tolerance=1e-10; fine.set_point_load(LoadId(0),*f,*mm); let o2=fine.solve(1e-9,&mut |_|{}); println!("   finer {:?} {:?} {:?}", tip(&mut fine).as_slice(), o2.path, o2.status);   p.solve(1e-6,&mut |q|println!("     {q:?}")); } } else {worst=worst.max(e);} }  let c=p.problem().counts(); evals+=c.factorisations; steps+=o.path.taken+o.path.refused; } }
  let t=Instant::now(); for _ in 0..5 { for (f,mm) in &loads { p.set_point_load(LoadId(0),*f,*mm); p.solve(1e-6,&mut |_|{}); } }
  println!("folds {st} wrong {bad} failed {failed} worst {worst:.1e} tangents/solve {:.1} steps/solve {:.1}  {:.0} solves/s", evals as f64/1000., steps as f64/1000., 5000./t.elapsed().as_secs_f64());
}
