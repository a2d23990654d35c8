// The driven cable of tests/sim/rod/rod_driven_cable.h in MuJoCo: rigid segments on ball joints whose springs are
// EI/l, half a cell at the clamps. Prints processor seconds per simulated second, and the error of the rms
// bending curvature against the beam elements listed in that header.
//
//     node mujoco_cable.mjs HEADER [SEGMENTS [STEP_MS]]
import { readFileSync } from "node:fs";
import load_mujoco from "mujoco-js";

const [header, segments = "40", step_ms = "1"] = process.argv.slice(2);
const n = Number(segments), h = Number(step_ms) / 1000;
const length = 2, mass_per_length = 2.5, stiffness = 3, damping_time = 0.01, radius = 0.03;
const begin = 4, end = 24, every = 0.01;  // of the comparison [s]
const l = length / n;

const quintic = (u) => (u <= 0 ? 0 : u >= 1 ? 1 : u ** 3 * (10 - 15 * u + 6 * u * u));

function tool(t) {
  const r = quintic(t / 3), s = quintic(t - 4), a = Math.PI * (t - 4);
  const half = (s * Math.PI * Math.sin(a)) / 8, v = Math.sin(half) / Math.sqrt(3);
  return {
    position: [2 - 0.9 * r + 0.3 * s * Math.sin(a), 0.5 * s * Math.cos(a), 0.3 * s * Math.sin(a + (4 * Math.PI) / 3)],
    quaternion: [Math.cos(half), v, v, v],
  };
}

/// Bodies lie along x; a joint's spring and damper belong to the cell of length `cell` around it.
function model_text() {
  const joint = (cell) => `<joint type="ball" stiffness="${stiffness / cell}" damping="${(damping_time * stiffness) / cell}"/>`;
  const mass = mass_per_length * l, across = mass * (l * l / 12 + 0.375 * radius * radius), along = mass * 0.75 * radius * radius;
  let open = "", close = "";
  for (let i = 0; i < n; ++i) {
    open += `<body pos="${i === 0 ? 0 : l} 0 0">${joint(i === 0 ? l / 2 : l)}` +
      `<inertial pos="${l / 2} 0 0" mass="${mass}" diaginertia="${along} ${across} ${across}"/>`;
    close += "</body>";
  }
  const last = `<body name="last" pos="${l} 0 0">${joint(l / 2)}<inertial pos="0 0 0" mass="0.1" diaginertia="1e-2 1e-2 1e-2"/></body>`;
  return `<mujoco><option timestep="${h}" integrator="implicitfast" gravity="0 0 0"><flag contact="disable"/></option>
    <worldbody><body name="tool" mocap="true" pos="2 0 0"/>${open}${last}${close}</worldbody>
    <equality><weld body1="tool" body2="last" solref="${2 * h} 1" solimp="0.99 0.99 0.001"/></equality></mujoco>`;
}

const mujoco = await load_mujoco();
mujoco.FS.writeFile("/cable.xml", model_text());
const model = mujoco.MjModel.loadFromXML("/cable.xml");
const data = new mujoco.MjData(model);
const place = data.mocap_pos, turn = data.mocap_quat, joints = data.qpos, gravity = model.opt.gravity;
const sum = new Float64Array(n + 1);
let counted = 0;
const started = process.cpuUsage();
const steps = Math.round(end / h), sample = Math.round(every / h);
for (let k = 0; k < steps; ++k) {
  gravity[2] = -9.81 * quintic((k * h) / 0.3);
  const pose = tool((k + 1) * h);
  place.set(pose.position);
  turn.set(pose.quaternion);
  mujoco.mj_step(model, data);
  if ((k + 1) * h < begin || (k + 1) % sample !== 0) continue;
  ++counted;
  for (let j = 0; j <= n; ++j) {  // bending: what turns the tangent, x
    const [w, x, y, z] = joints.subarray(4 * j, 4 * j + 4);
    const angle = 2 * Math.atan2(Math.hypot(y, z), Math.hypot(w, x));
    const cell = j === 0 || j === n ? l / 2 : l;
    sum[j] += (angle / cell) ** 2;
  }
}
const used = process.cpuUsage(started);
/// At s links from the base: the cubic through the four links around it, as in the header.
function mean_square(s) {
  const first = Math.min(Math.max(Math.floor(s) - 1, 0), n - 3);
  let value = 0;
  for (let a = 0; a < 4; ++a) {
    let weight = 1 / counted;
    for (let b = 0; b < 4; ++b) if (b !== a) weight *= (s - first - b) / (a - b);
    value += weight * sum[first + a];
  }
  return value;
}

const beam = [...readFileSync(header, "utf8").split("beam_curvature")[1].matchAll(/\{([\d.]+), ([\d.]+)\}/g)].map((m) => Number(m[2]));
let off = 0, size = 0;
beam.forEach((expected, k) => {
  off += (Math.sqrt(mean_square((0.0125 + 0.025 * k) / l)) - expected) ** 2;
  size += expected ** 2;
});
const seconds = (used.user + used.system) / 1e6 / end;
console.log(`mujoco_cpu_s_per_s_n${n} ${seconds.toFixed(4)}`);
console.log(`mujoco_rms_curvature_error ${Math.sqrt(off / size).toFixed(5)}`);
