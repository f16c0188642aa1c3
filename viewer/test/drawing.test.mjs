// What is drawn, and that it is where and as large as the document says.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { browser, opened } from "./chrome.mjs";
import { BENT, made, madeOf, model, pixels, settled, shown } from "./support.mjs";

let chrome;
let context;
before(async () => {
  chrome = await browser();
  context = await chrome.newContext({ viewport: { width: 1100, height: 700 }, colorScheme: "light" });
});
after(() => chrome.close());

const GROUND = { position: [0, 0, 0] };
const BODY = { body: "block", position: [0, 0, 0] };
const CIRCLE = {
  shape: "curve",
  points: Array.from({ length: 33 }, (_, i) => [0.02 * Math.cos((i * Math.PI) / 16), 0.02 * Math.sin((i * Math.PI) / 16), 0]),
};
const CAP = {
  shape: "net",
  rows: 5,
  points: Array.from({ length: 5 * 16 }, (_, i) => {
    const [row, angle] = [Math.floor(i / 16) + 1, ((i % 16) * Math.PI) / 8];
    return [0.004 * row * Math.cos(angle), 0.004 * row * Math.sin(angle), 0.001 * row * row];
  }),
};
const BOUNDARIES = {
  rolling: { child: CIRCLE, parent: { shape: "line", point: [0, -0.02, 0], direction: [1, 0, 0] } },
  contact: { child: CAP, parent: { shape: "plane" } },
  surface_rolling: { child: CAP, parent: { shape: "cylinder", semi_axes: [0.01, 0.015] } },
};

/** A block on the ground, held by one joint. */
function held(kind) {
  const boundaries = BOUNDARIES[kind];
  const contact = boundaries ? { contact: { point: [0, -0.02, 0], normal: [0, 1, 0], force: 3 } } : {};
  const pose = { position: [0, 0, 0], rotation: [1, 0, 0, 0] };
  const arm = { body: "block", position: [0.1, 0, 0] };
  return {
    flexura: "0",
    study: "solve",
    model: kind,
    status: "converged",
    beams: {},
    bodies: { block: pose },
    joints: { held: { force: [0, 0, 0], moment: [0, 0, 0], ...contact } },
    scene: {
      units: { outputs: {}, parameters: {} },
      gravity: [0, 0, 0],
      beams: {},
      bodies: { block: { ...pose, mass: 0, center_of_mass: [0, 0, 0] } },
      joints: { held: { kind, parent: GROUND, child: BODY, axis: [0, 0, 1], second_axis: [1, 0, 0], driven: false, ...(boundaries ? { boundaries } : {}) } },
      loads: { push: { place: arm, force: [0, 0, 0], moment: [0, 0, 0], frame: "global" } },
    },
  };
}

const KINDS = ["weld", "revolute", "prismatic", "cylindrical", "universal", "spherical", "planar", "free", "rolling", "contact", "surface_rolling"];

test("every kind of joint has a mark of its own", async () => {
  const seen = new Map();
  for (const kind of [...KINDS, "unknown"]) {
    const { page, complaints } = await opened(context, shown(`joint-${kind}`, held(kind)));
    assert.deepEqual(complaints, []);
    await page.evaluate(() => ["names", "ghost"].forEach((option) => window.flexura.app.set(option, false)));
    await settled(page);
    seen.set(kind, await page.evaluate(() => window.flexura.app.viewport.canvas.toDataURL("image/png")));
    await page.close();
  }
  const bare = seen.get("unknown");
  for (const kind of KINDS) {
    assert.notEqual(seen.get(kind), bare, `nothing is drawn for ${kind}`);
    for (const other of KINDS) if (other !== kind) assert.notEqual(seen.get(kind), seen.get(other), `${kind} looks like ${other}`);
  }
});

test("a joint's mark stands on its axis", async () => {
  const picture = async (axis) => {
    const document = held("revolute");
    document.scene.joints.held.axis = axis;
    const { page } = await opened(context, shown(`axis-${axis.join("")}`, document));
    const url = await page.evaluate(() => window.flexura.app.viewport.canvas.toDataURL("image/png"));
    await page.close();
    return url;
  };
  assert.notEqual(await picture([0, 0, 1]), await picture([0, 1, 0]));
});

test("each thing that can be shown or left out changes the picture", async () => {
  const { page } = await opened(context, made("all-options", "solve", model("ellipsoid_in_dish")).page);
  const strip = await opened(context, made("strip-options", "solve", model("tapered_beam")).page);
  const changes = async (on, option) => {
    const take = () => on.evaluate(() => window.flexura.picture());
    await settled(on);
    const before = await take();
    const isOn = await on.evaluate((name) => window.flexura.app.options[name], option);
    await on.evaluate(([name, value]) => window.flexura.app.set(name, value), [option, !isOn]);
    await settled(on);
    assert.notEqual(await take(), before, option);
    await on.evaluate(([name, value]) => window.flexura.app.set(name, value), [option, isOn]);
    await settled(on);
    assert.equal(await take(), before, `${option} and back`);
  };
  for (const option of ["loads", "names", "surfaces"]) await changes(page, option);
  for (const option of ["ghost", "loads", "reactions", "frames"]) await changes(strip.page, option);
  await page.close();
  await strip.page.close();
});

const NAMED = [
  ["tendon_robot", ["tendon_1 1 N|tendon_1 6 N", "gripper 20 g", "backbone", "400 mN/m"]],
  ["wing_ligaments", ["a 5.6 N", "b 3.25 N", "c 5.2 N", "humerus"]],
  ["ellipsoid_in_dish", ["pull 500 mN", "dish 2 N", "tether 3.38 mN"]],
  ["cable_polygon", ["rope 10 N"]],
  ["cantilever_strip", ["payload 50 g"]],
];
for (const [name, wanted] of NAMED) {
  test(`what acts in ${name} is named, with its value`, async () => {
    const { page } = await opened(context, made(`named-${name}`, "solve", model(name)).page);
    const labels = await page.evaluate(() => window.flexura.labels);
    for (const text of wanted) assert.ok(text.split("|").some((one) => labels.includes(one)), `${text} is not among ${labels.join("; ")}`);
    await page.close();
  });
}

test("reactions hold the loads in balance", async () => {
  const toml = BENT.replace('push = "0 N"', 'push = "3 N"');
  const { page } = await opened(context, madeOf("reactions", toml).page);
  await page.evaluate(() => window.flexura.app.set("reactions", true));
  const labels = await page.evaluate(() => window.flexura.labels);
  assert.ok(labels.includes("tip 3 N") && labels.includes("strip 3 N"), labels.join("; "));
  await page.close();
});

test("gravity is shown with its size, and points down", async () => {
  const { page } = await opened(context, made("gravity", "solve", model("cantilever_strip")).page);
  assert.deepEqual(await page.evaluate(() => window.flexura.app.viewport.overlay.gravity), [0, 0, -9.81]);
  await page.close();
});

test("a beam is as wide and as high on the screen as its section, where it tapers too", async () => {
  const toml = BENT.replace('width = "20 mm"', 'width = "20 mm + 0.2*s"').replace('height = "0.5 mm"', 'height = "8 mm"');
  const { page } = await opened(context, madeOf("taper", toml).page);
  await page.evaluate(() => ["loads", "names", "ghost"].forEach((name) => window.flexura.app.set(name, false)));
  await page.selectOption("#camera", { label: "parallel" });
  const seen = async (view) => {
    await page.click(view);
    await settled(page);
    const { box } = await pixels(page);
    const per = await page.evaluate(() => 1 / window.flexura.app.viewport.metresPerPixel);
    return { width: (box.right - box.left) / per, height: (box.bottom - box.top) / per, pixel: 1 / per };
  };
  const [above, front] = [await seen("#view-xy"), await seen("#view-xz")];
  // Marks at the clamp are a little larger than the section there.
  assert.ok(Math.abs(above.height - 0.06) < 3 * above.pixel, `${above.height} m wide`);
  assert.ok(front.height >= 0.008 - 2 * front.pixel && front.height < 0.02, `${front.height} m high`);
  await page.close();
});

test("a tube is hollow at its ends", async () => {
  const count = async (shape) => {
    const toml = BENT.replace('shape = "rectangle"\nwidth = "20 mm"\nheight = "0.5 mm"', shape);
    const { page } = await opened(context, madeOf(`tube-${shape.length}`, toml).page);
    const { triangles } = await page.evaluate(() => window.flexura.counts);
    await page.close();
    return triangles;
  };
  const tube = await count('shape = "tube"\nouter_diameter = "10 mm"\ninner_diameter = "8 mm"');
  const rod = await count('shape = "circle"\ndiameter = "10 mm"');
  // A ring has two triangles for each side, a disc two less than sides.
  assert.equal(tube - rod, 2 * (2 * 16 - 14));
});

test("the scale of colours goes from the smallest to the largest value, in units that read well", async () => {
  const { page: path, document } = made("scale", "solve", model("cantilever_strip"));
  const { page } = await opened(context, path);
  const [name] = Object.keys(document.beams);
  const scale = () => page.evaluate(() => window.flexura.app.viewport.overlay.scale);
  const colours = () => pixels(page).then(({ colours }) => colours);
  for (const [key, unit, list] of [
    ["stress", "Pa", document.beams[name].stress],
    ["strain", "", document.beams[name].strain],
    ["force", "N", document.beams[name].force.map((f) => Math.hypot(...f))],
    ["curvature", "1/m", document.beams[name].curvature.map((k) => Math.hypot(k[1], k[2]))],
  ]) {
    await page.evaluate((key) => window.flexura.app.setQuantity(key), key);
    await settled(page);
    const { range, unit: own } = await scale();
    assert.equal(own, unit);
    [Math.min(...list), Math.max(...list)].forEach((end, i) => assert.ok(Math.abs(range[i] - end) <= 1e-9 * Math.max(...list), `${key}: ${range[i]} ${end}`));
    assert.ok((await colours()) > 40, key);
  }
  await page.evaluate(() => window.flexura.app.setQuantity(""));
  assert.equal(await scale(), null);
  await page.close();
});

test("nothing lies under the scale of colours", async () => {
  for (const name of ["ends_clamped", "shallow_arch", "parallelogram_stage"]) {
    const { page } = await opened(context, made(`beside-${name}`, "solve", model(name)).page);
    await page.evaluate(() => ["loads", "names"].forEach((option) => window.flexura.app.set(option, false)));
    await settled(page);
    const { box } = await pixels(page);
    const width = await page.evaluate(() => document.querySelector("canvas.window").getBoundingClientRect().width);
    assert.ok(box.right < width - 90 && box.left > 2, `${name}: ${box.left} to ${box.right} of ${width}`);
    await page.close();
  }
});

test("views look along the axes, and from the other side when asked again", async () => {
  const { page } = await opened(context, madeOf("views", BENT).page);
  await page.selectOption("#camera", { label: "parallel" });
  const unit = () =>
    page.evaluate(() => {
      const { project } = window.flexura;
      const o = project([0, 0, 0]);
      return [[0.1, 0, 0], [0, 0.1, 0], [0, 0, 0.1]].map((p) => project(p).slice(0, 2).map((c, i) => Math.round(c - o[i])));
    });
  const flat = (list) => list.map(([x, y]) => [Math.sign(x), Math.sign(y)]);
  const wanted = {
    "#view-xz": [[[1, 0], [0, 0], [0, -1]], [[-1, 0], [0, 0], [0, -1]]],
    "#view-xy": [[[1, 0], [0, -1], [0, 0]], [[1, 0], [0, 1], [0, 0]]],
    "#view-yz": [[[0, 0], [1, 0], [0, -1]], [[0, 0], [-1, 0], [0, -1]]],
  };
  for (const [button, sides] of Object.entries(wanted)) {
    for (const side of sides) {
      await page.click(button);
      await settled(page);
      assert.deepEqual(flat(await unit()).map((pair) => pair.map((s) => s + 0)), side, button);
    }
  }
  await page.close();
});

test("a parallel view shows equal lengths equally long, a perspective one does not", async () => {
  const { page } = await opened(context, madeOf("cameras", BENT).page);
  await page.click("#view-3-D");
  const lengths = async () => {
    await settled(page);
    return page.evaluate(() => {
      const { project } = window.flexura;
      return [-0.3, 0.3].map((y) => {
        const [a, b] = [project([0, y, 0]), project([0, y, 0.1])];
        return Math.hypot(a[0] - b[0], a[1] - b[1]);
      });
    });
  };
  const [far, near] = await lengths();
  assert.ok(Math.abs(far - near) > 3, `${far} ${near}`);
  await page.selectOption("#camera", { label: "parallel" });
  const [one, other] = await lengths();
  assert.ok(Math.abs(one - other) < 0.1, `${one} ${other}`);
  await page.close();
});

test("a magnified picture says so and shows no contact where there is none", async () => {
  const { page } = await opened(context, made("magnified", "solve", model("rolling_beam")).page);
  const has = (word) => page.evaluate((word) => window.flexura.labels.some((label) => label.startsWith(word)), word);
  assert.ok(await has("ground"));
  await page.evaluate(() => window.flexura.app.setMagnification(3));
  await settled(page);
  assert.ok(!(await has("ground")));
  assert.match(await page.textContent("#said"), /displacements × 3/);
  await page.close();
});
