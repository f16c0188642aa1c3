use flexura_model::*; use flexura_spatial::*; use flexura_study::*; use std::time::Instant;
fn sec(ea:f64,gj:f64,ei:f64,ga:f64)->Section{Section{name:"s".into(),shape:Shape::Stiffness{ea:ea.into(),gj:gj.into(),ei2:ei.into(),ei3:ei.into(),ga2:Some(ga.into()),ga3:Some(ga.into()),mass_per_length:None},plane_strain:false}}
fn model(s:Section,curve:Curve,theory:BeamTheory,place:Option<Pose>,f:Vector3<f64>)->Model{ let mut m=Model::default(); m.sections.push(s);
 m.beams.push(Beam{name:"b".into(),material:None,section:SectionId(0),curve,frame:SectionFrame::Natural,theory,start:Some(End{body:BodyRef::Ground,placement:place,hold:JointLaw::weld()}),end:None,distributed:vec![]});
 m.loads.push(Load{name:"l".into(),target:LoadTarget::Beam(BeamPoint{beam:BeamId(0),at:At::Fraction(1.0)}),force:f,moment:Vector3::zeros(),frame:LoadFrame::Global}); m}
fn run(name:&str,m:&Model,f:Vector3<f64>,fac:f64){
  for tol in [1e-5,1e-6,1e-8,1e-11] {
   let mut p=Prepared::new(m).unwrap(); let o=p.solve(tol,&mut |_|{}); let s=p.solution(&o,11); let b=&s.beams[0].samples; let tip=b.last().unwrap();
   let d=tip.pose.position-tip.rest_pose.position;
   let n=200; let t=Instant::now(); for _ in 0..n {p.solve(tol,&mut |_|{});} let cold=t.elapsed().as_secs_f64()/n as f64;
   p.solve(tol,&mut |_|{}); let t=Instant::now(); let mut c=Default::default(); for i in 0..n { let g=if i%2==0 {fac} else {1.0}; p.set_point_load(LoadId(0),f*g,Vector3::zeros()); let a=p.problem().counts(); p.solve_from_here(tol,&mut |_|{}); let b=p.problem().counts(); c=(b.factorisations as i64-a.factorisations as i64,b.residuals as i64-a.residuals as i64);} let warm=t.elapsed().as_secs_f64()/n as f64;
   println!("{name} tol {tol:e} {:?} est {:.1e} d {:.10} {:.10} {:.10} {:?} cold {:.1} warm {:.1} us {c:?}",o.status,o.error_estimate,d.x,d.y,d.z,s.work,cold*1e6,warm*1e6);
  } }
fn main(){
  let q=exp(&Vector3::new(0.,0.,std::f64::consts::FRAC_PI_2)); // x->y ; e2 -> -x ; need bend to +x: rotate about e1 by pi
  let q=q*exp(&Vector3::new(std::f64::consts::PI,0.,0.));
  for j in [1.0/6.0,0.141] { let f=Vector3::new(0.,0.,600.); run("bend",&model(sec(1e7,5e6*j,1e7/12.0,5e6),Curve::Arc{radius:100.0,angle:std::f64::consts::FRAC_PI_4},BeamTheory{shear:true,extension:true},Some(Pose::new(q,Vector3::zeros())),f),f,1.01); }
  let r=0.6985e-3f64; let i=std::f64::consts::PI*r.powi(4)/4.0; let a=std::f64::consts::PI*r*r;
  for (c,g,ff) in [("pull",1.0,5.0),("push",-1.0,5.0)] { for pitch in [5.715e-3,5.715e-3*std::f64::consts::TAU] {
   let rad=7.239e-3; let pp=pitch/std::f64::consts::TAU; let k=rad/(rad*rad+pp*pp); let t=pp/(rad*rad+pp*pp); let n=(k*k+t*t).sqrt(); let f=Vector3::new(t/n,0.,k/n)*(g*ff);
   run(c,&model(sec(193e9*a,80.8e9*2.0*i,193e9*i,80.8e9*a),Curve::Helix{radius:rad,pitch,turns:10.0},BeamTheory::default(),None,f),f,1.01); } }
  let f=Vector3::new(0.,10.,0.); run("elastica10",&model(sec(1.0,1.0,1.0,1.0),Curve::Straight{length:1.0},BeamTheory{shear:false,extension:false},None,f),f,1.01);
}
