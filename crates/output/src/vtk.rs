//! `model.vtp`: VTK XML PolyData for ParaView and PyVista.
//!
//! One polyline a beam through the deformed samples, one a set of concentric tubes along their axis, and one a cable
//! along its course. Numbers are written as inline base64 (a 32-bit byte count, then the little-endian values), which
//! is exact and can hold NaN where a beam has no stress.

use flexura_model::{Model, visible};
use flexura_post::Evaluation;
use flexura_solution::{BeamSample, Solution};
use flexura_spatial::{Pose, Vector3, Wrench};

/// The deformed beams with their fields, behind them the concentric tubes, and behind those the cables.
///
/// Point data: `s`, `displacement`, `force`, `moment`, `curvature`, `stretch`, `director_e1`,
/// `director_e2`, `director_e3`, `strain`, `stress` (the last two NaN for a section given as a stiffness; on tubes these
/// two, `displacement` and `stretch`, and all of them on cables). Cell data: `beam`, `tubes` and `cable`, the position in
/// the model's list or -1, and `tension`, NaN but for a cable. Field data: `status`, how the solve ended, `beam_names`, and
/// `tubes_names` and `cable_names` where there are such.
pub fn model_vtp(model: &Model, solution: &Solution, evaluation: &Evaluation) -> String {
    let samples: Vec<&BeamSample> = solution.beams.iter().flat_map(|beam| &beam.samples).collect();
    let course: Vec<Vector3<f64>> = solution.cables.iter().flat_map(|cable| &cable.course).copied().collect();
    let beams = solution.beams.iter().map(|beam| beam.samples.len());
    let tubes = solution.tubes.iter().map(|tubes| tubes.samples.len());
    let lines: Vec<usize> =
        beams.chain(tubes).chain(solution.cables.iter().map(|cable| cable.course.len())).collect();
    let mut ends = Vec::with_capacity(lines.len());
    for count in &lines {
        ends.push(ends.last().copied().unwrap_or(0) + *count as i64);
    }
    let of_beams = samples.iter().map(|sample| Section {
        s: sample.s,
        pose: sample.pose,
        wrench: sample.wrench,
        curvature: sample.curvature,
    });
    let of_tubes = solution.tubes.iter().flat_map(|tubes| &tubes.samples).map(|sample| Section {
        s: sample.s,
        pose: sample.pose,
        wrench: sample.wrench,
        curvature: sample.curvature,
    });
    let sections: Vec<Section> = of_beams.chain(of_tubes).collect();
    let points = sections.len() + course.len();
    let stress: Vec<[f64; 2]> = solution
        .beams
        .iter()
        .zip(&evaluation.beams)
        .flat_map(|(beam, stress)| {
            (0..beam.samples.len()).map(move |i| match stress {
                Some(stress) => [stress.samples[i].strain, stress.samples[i].von_mises],
                None => [f64::NAN; 2],
            })
        })
        .collect();

    // Points of cables have no values of sections, those of tubes none that beams alone have.
    let padded = |name: &str, components: usize, mut values: Vec<f64>| {
        values.resize(components * points, f64::NAN);
        floats(name, components, &values)
    };
    let vectors = |name: &str, pick: &dyn Fn(&Section) -> Vector3<f64>| {
        padded(name, 3, sections.iter().flat_map(|section| <[f64; 3]>::from(pick(section))).collect())
    };
    let director = |axis: Vector3<f64>| move |section: &Section| section.pose.rotation * axis;
    let displacements = samples.iter().map(|sample| sample.pose.position - sample.rest_pose.position);

    let mut text = String::from(concat!(
        "<?xml version=\"1.0\"?>\n",
        "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt32\">\n",
        "<PolyData>\n<FieldData>\n",
    ));
    text += &names("status", std::iter::once(solution.status.word()));
    text += &names("beam_names", model.beams.iter().map(|beam| beam.name.as_str()));
    if !model.tubes.is_empty() {
        text += &names("tubes_names", model.tubes.iter().map(|tubes| tubes.name.as_str()));
    }
    if !model.cables.is_empty() {
        text += &names("cable_names", model.cables.iter().map(|cable| cable.name.as_str()));
    }
    text += &format!(
        "</FieldData>\n<Piece NumberOfPoints=\"{points}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
        lines.len()
    );
    text += "<PointData>\n";
    text += &padded("s", 1, sections.iter().map(|section| section.s).collect());
    text += &padded("displacement", 3, displacements.flat_map(<[f64; 3]>::from).collect());
    text += &vectors("force", &|section| section.wrench.force);
    text += &vectors("moment", &|section| section.wrench.moment);
    text += &vectors("curvature", &|section| section.curvature);
    text += &padded("stretch", 1, samples.iter().map(|sample| sample.strain.x).collect());
    text += &vectors("director_e1", &director(Vector3::x()));
    text += &vectors("director_e2", &director(Vector3::y()));
    text += &vectors("director_e3", &director(Vector3::z()));
    text += &padded("strain", 1, stress.iter().map(|pair| pair[0]).collect());
    text += &padded("stress", 1, stress.iter().map(|pair| pair[1]).collect());
    text += "</PointData>\n<CellData>\n";
    let (beams, tubes, cables) = (solution.beams.len(), solution.tubes.len(), solution.cables.len());
    let none = |count: usize| std::iter::repeat_n(-1, count);
    text += &integers("beam", (0..beams as i64).chain(none(tubes + cables)));
    text += &integers("tubes", none(beams).chain(0..tubes as i64).chain(none(cables)));
    text += &integers("cable", none(beams + tubes).chain(0..cables as i64));
    let tensions = solution.cables.iter().map(|cable| cable.tension);
    text += &floats(
        "tension",
        1,
        &std::iter::repeat_n(f64::NAN, beams + tubes).chain(tensions).collect::<Vec<_>>(),
    );
    text += "</CellData>\n<Points>\n";
    let places = sections.iter().map(|section| section.pose.position).chain(course);
    text += &floats("Points", 3, &places.flat_map(<[f64; 3]>::from).collect::<Vec<_>>());
    text += "</Points>\n<Lines>\n";
    text += &integers("connectivity", 0..points as i64);
    text += &integers("offsets", ends.into_iter());
    text += "</Lines>\n</Piece>\n</PolyData>\n</VTKFile>\n";
    text
}

/// What beams and tubes have at a sample.
struct Section {
    s: f64,
    pose: Pose,
    wrench: Wrench,
    curvature: Vector3<f64>,
}

fn floats(name: &str, components: usize, values: &[f64]) -> String {
    let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
    array("Float64", name, &format!("NumberOfComponents=\"{components}\""), &bytes)
}

fn integers(name: &str, values: impl Iterator<Item = i64>) -> String {
    let bytes: Vec<u8> = values.flat_map(i64::to_le_bytes).collect();
    array("Int64", name, "NumberOfComponents=\"1\"", &bytes)
}

/// Strings are stored one after another, each closed by a zero byte.
fn names<'a>(title: &str, names: impl ExactSizeIterator<Item = &'a str>) -> String {
    let count = names.len();
    let bytes: Vec<u8> =
        names.flat_map(|name| visible(name).bytes().chain([0]).collect::<Vec<_>>()).collect();
    array("String", title, &format!("NumberOfTuples=\"{count}\""), &bytes)
}

fn array(kind: &str, name: &str, attributes: &str, bytes: &[u8]) -> String {
    let mut block = (bytes.len() as u32).to_le_bytes().to_vec();
    block.extend_from_slice(bytes);
    format!(
        "<DataArray type=\"{kind}\" Name=\"{name}\" {attributes} format=\"binary\">{}</DataArray>\n",
        base64(&block)
    )
}

fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let at = |i: usize| u32::from(chunk.get(i).copied().unwrap_or(0));
        let group = at(0) << 16 | at(1) << 8 | at(2);
        for digit in 0..4 {
            if digit <= chunk.len() {
                text.push(char::from(DIGITS[(group >> (18 - 6 * digit) & 63) as usize]));
            } else {
                text.push('=');
            }
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::base64;

    #[test]
    fn base64_pads_as_rfc_4648_says() {
        let cases = [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")];
        for (plain, coded) in cases {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }
}
