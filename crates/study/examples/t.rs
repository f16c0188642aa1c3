use flexura_model::*;
use flexura_spatial::*;
use flexura_study::*;
use std::time::Instant;
pub fn cantilever(force: Vector3<f64>, moment: Vector3<f64>) -> Model {
    let mut m = Model::default();
    m.sections.push(Section{name:"s".into(),shape:Shape::Stiffness{ea:1.0.into(),gj:(1.0/1.3).into(),ei2:1.0.into(),ei3:1.0.into(),ga2:None,ga3:None,mass_per_length:None},plane_strain:false});
    m.beams.push(Beam{name:"b".into(),material:None,section:SectionId(0),curve:Curve::Straight{length:1.0},frame:SectionFrame::Natural,theory:BeamTheory{shear:false,extension:false},
      start:Some(End{body:BodyRef::Ground,placement:None,hold:JointLaw::weld()}),end:None,distributed:vec![]});
    m.loads.push(Load{name:"l".into(),target:LoadTarget::Beam(BeamPoint{beam:BeamId(0),at:At::Fraction(1.0)}),force,moment,frame:LoadFrame::Global});
    m
}
fn main(){
  for (f,mm) in [(Vector3::new(0.,1.,0.),Vector3::zeros()),(Vector3::new(0.,10.,0.),Vector3::zeros()),(Vector3::new(0.,50.,0.),Vector3::zeros()),(Vector3::zeros(),Vector3::new(0.,0.,5.0*std::f64::consts::TAU)),(Vector3::new(3.,5.,-6.),Vector3::new(0.3,-0.5,0.4))] {
    let m=cantilever(f,mm);
    for tol in [1e-6,1e-8,1e-11] {
    let mut p=Prepared::new(&m).unwrap();
    let o=p.solve(tol,&mut |_|{});
    let n=200; let t=Instant::now();
    for _ in 0..n { p.solve(tol,&mut |_|{}); }
    let cold=t.elapsed().as_secs_f64()/n as f64;
    let s=p.solution(&o,11);
    let tip=s.beams[0].samples.last().unwrap().pose.position;
    println!("f {:?} tol {tol:e}: {:?} est {:.1e} tip {:.12} {:.12} {:.12} | {:?} cold {:.1} us", f.as_slice(), o.status,o.error_estimate, tip.x,tip.y,tip.z, s.work, cold*1e6);
    }
  }
}
