//! Lumped masses and loads.

use super::place::{On, beam_point, either, point};
use crate::context::{Needed, Read, Reported};
use crate::reader::Reader;
use flexura_model::{BeamId, BeamPoint, BodyId, Load, LoadFrame, LoadTarget, PointMass};
use flexura_spatial::Vector3;

pub(super) fn mass(reader: &Reader<'_, '_>, name: String) -> Read<PointMass> {
    let beam = reader.name("beam").needed();
    let at = reader.station("at").needed();
    let mass = reader.number("mass").needed();
    let inertia = super::body::inertia(reader);
    Ok(PointMass { name, point: BeamPoint { beam: BeamId(beam?), at: at? }, mass: mass?, inertia: inertia? })
}

pub(super) fn load(reader: &Reader<'_, '_>, name: String) -> Read<Load> {
    let target = target(reader);
    let force = reader.vector("force");
    let moment = reader.vector("moment");
    let frame = reader.choice("frame");
    let (force, moment) = (force?, moment?);
    if force.is_none() && moment.is_none() {
        return Err(reader
            .wrong_with_hint("a load needs `force` or `moment`", "for example `force = [0, 0, \"-2 N\"]`"));
    }
    Ok(Load {
        name,
        target: target?,
        force: force.unwrap_or_else(Vector3::zeros),
        moment: moment.unwrap_or_else(Vector3::zeros),
        frame: if frame? == Some("local") { LoadFrame::Local } else { LoadFrame::Global },
    })
}

fn target(reader: &Reader<'_, '_>) -> Read<LoadTarget> {
    match either(reader)? {
        On::Body => {
            let body = reader.name("body").needed();
            let point = point(reader);
            match body {
                Ok(body) => Ok(LoadTarget::Body { body: BodyId(body), point: point? }),
                Err(Reported) => Err(Reported),
            }
        }
        On::Beam => beam_point(reader).map(LoadTarget::Beam),
    }
}
