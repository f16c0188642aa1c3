//! `model.vtp`: VTK XML PolyData for ParaView and PyVista.
//!
//! One polyline a beam through the deformed samples, and one a cable along its course. Numbers are written as inline base64 (a 32-bit byte
//! count, then the little-endian values), which is exact and can hold NaN where a beam has no stress.

use flexura_model::Model;
use flexura_post::Evaluation;
use flexura_solution::{BeamSample, Solution};
use flexura_spatial::Vector3;

/// The deformed beams with their fields, and behind them the cables.
///
/// Point data: `s`, `displacement`, `force`, `moment`, `curvature`, `stretch`, `director_e1`,
/// `director_e2`, `director_e3`, `strain`, `stress` (the last two NaN for a section given as a stiffness, all of them on
/// cables). Cell data: `beam` and `cable`, the position in the model's list or -1, and `tension`, NaN for a beam.
/// Field data: `beam_names`, and `cable_names` where there are cables.
pub fn model_vtp(model: &Model, solution: &Solution, evaluation: &Evaluation) -> String {
    let samples: Vec<&BeamSample> = solution.beams.iter().flat_map(|beam| &beam.samples).collect();
    let course: Vec<Vector3<f64>> = solution.cables.iter().flat_map(|cable| &cable.course).copied().collect();
    let beams = solution.beams.iter().map(|beam| beam.samples.len());
    let lines: Vec<usize> = beams.chain(solution.cables.iter().map(|cable| cable.course.len())).collect();
    let mut ends = Vec::with_capacity(lines.len());
    for count in &lines {
        ends.push(ends.last().copied().unwrap_or(0) + *count as i64);
    }
    let points = samples.len() + course.len();
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

    // A cable has no sections, so its points have no such values.
    let padded = |name: &str, components: usize, mut values: Vec<f64>| {
        values.resize(components * points, f64::NAN);
        floats(name, components, &values)
    };
    let vectors = |name: &str, pick: &dyn Fn(&BeamSample) -> Vector3<f64>| {
        padded(name, 3, samples.iter().flat_map(|sample| <[f64; 3]>::from(pick(sample))).collect())
    };
    let scalars = |name: &str, pick: &dyn Fn(&BeamSample) -> f64| {
        padded(name, 1, samples.iter().map(|sample| pick(sample)).collect())
    };
    let director = |axis: Vector3<f64>| move |sample: &BeamSample| sample.pose.rotation * axis;

    let mut text = String::from(concat!(
        "<?xml version=\"1.0\"?>\n",
        "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt32\">\n",
        "<PolyData>\n<FieldData>\n",
    ));
    text += &names("beam_names", model.beams.iter().map(|beam| beam.name.as_str()));
    if !model.cables.is_empty() {
        text += &names("cable_names", model.cables.iter().map(|cable| cable.name.as_str()));
    }
    text += &format!(
        "</FieldData>\n<Piece NumberOfPoints=\"{points}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
        lines.len()
    );
    text += "<PointData>\n";
    text += &scalars("s", &|sample| sample.s);
    text += &vectors("displacement", &|sample| sample.pose.position - sample.rest_pose.position);
    text += &vectors("force", &|sample| sample.wrench.force);
    text += &vectors("moment", &|sample| sample.wrench.moment);
    text += &vectors("curvature", &|sample| sample.curvature);
    text += &scalars("stretch", &|sample| sample.strain.x);
    text += &vectors("director_e1", &director(Vector3::x()));
    text += &vectors("director_e2", &director(Vector3::y()));
    text += &vectors("director_e3", &director(Vector3::z()));
    text += &padded("strain", 1, stress.iter().map(|pair| pair[0]).collect());
    text += &padded("stress", 1, stress.iter().map(|pair| pair[1]).collect());
    text += "</PointData>\n<CellData>\n";
    let (beams, cables) = (solution.beams.len(), solution.cables.len());
    let none = |count: usize| std::iter::repeat_n(-1, count);
    text += &integers("beam", (0..beams as i64).chain(none(cables)));
    text += &integers("cable", none(beams).chain(0..cables as i64));
    let tensions = solution.cables.iter().map(|cable| cable.tension);
    text += &floats("tension", 1, &std::iter::repeat_n(f64::NAN, beams).chain(tensions).collect::<Vec<_>>());
    text += "</CellData>\n<Points>\n";
    let places = samples.iter().map(|sample| sample.pose.position).chain(course);
    text += &floats("Points", 3, &places.flat_map(<[f64; 3]>::from).collect::<Vec<_>>());
    text += "</Points>\n<Lines>\n";
    text += &integers("connectivity", 0..points as i64);
    text += &integers("offsets", ends.into_iter());
    text += "</Lines>\n</Piece>\n</PolyData>\n</VTKFile>\n";
    text
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
    let bytes: Vec<u8> = names.flat_map(|name| name.bytes().chain([0])).collect();
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
