"use strict";
// Draws the recorded sheet on a canvas: parallel projection, triangles from back to front.
(() => {
  const at = (id) => document.getElementById(id);
  const data = JSON.parse(at("data").textContent);
  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
  const place = new Uint16Array(bytes(data.place)); // frame, axis, point
  const colour = new Uint8Array(bytes(data.colour)); // frame, point
  const triangles = new Uint16Array(bytes(data.triangles));
  const edges = new Uint16Array(bytes(data.edges));
  const { points, frames, axes, low, unit, step, turn, first, laps, size } = data;
  const canvas = at("view"), pen = canvas.getContext("2d");
  const flat = axes === 2;
  const x = new Float64Array(points), y = new Float64Array(points), z = new Float64Array(points);
  const right = new Float64Array(points), up = new Float64Array(points), near = new Float64Array(points);
  const depth = new Float64Array(triangles.length / 3);
  const order = Uint32Array.from(depth, (_, k) => k);
  const span = (frames - 1) * laps; // of the film, in frames
  let yaw = -0.6, pitch = flat ? 1.0 : 0.5, zoom = 1, height = 1, now = 0, last = 0;
  let playing = !matchMedia("(prefers-reduced-motion: reduce)").matches;

  const pose = (lap) => { // where the repetition begins: turned by lap turns, shifted by all steps
    let dx = 0, dy = 0;
    for (let k = 0; k < lap; k++) {
      dx += Math.cos(k * turn) * step[0] - Math.sin(k * turn) * step[1];
      dy += Math.sin(k * turn) * step[0] + Math.cos(k * turn) * step[1];
    }
    return [dx, dy, lap * turn];
  };

  const move = (time) => { // positions of all points, linearly between two frames
    const lap = Math.min(Math.floor(time / (frames - 1)), laps - 1), inside = time - lap * (frames - 1);
    const a = Math.min(Math.floor(inside), frames - 2), share = inside - a;
    const [dx, dy, angle] = pose(lap), cos = Math.cos(angle), sin = Math.sin(angle);
    const value = (axis, k) => {
      const from = place[(a * axes + axis) * points + k], to = place[((a + 1) * axes + axis) * points + k];
      return low[axis] + unit[axis] * (from + share * (to - from));
    };
    for (let k = 0; k < points; k++) {
      const px = value(0, k) - first[0], py = value(1, k) - first[1];
      x[k] = first[0] + dx + cos * px - sin * py;
      y[k] = first[1] + dy + sin * px + cos * py;
      z[k] = flat ? 0 : value(2, k);
    }
    return share < 0.5 ? a : a + 1;
  };

  const project = (px, py, pz) => { // to pixels to the right and upwards, and nearness
    const cy = Math.cos(yaw), sy = Math.sin(yaw), cp = Math.cos(pitch), sp = Math.sin(pitch);
    const u = px - data.middle[0], v = py - data.middle[1], w = height * pz;
    const across = cy * v - sy * u, away = sy * v + cy * u; // y to the right, x towards the viewer
    return [across, cp * w - sp * away, cp * away + sp * w];
  };

  const line = (places) => {
    pen.beginPath();
    for (const p of places) pen.lineTo(...screen(p[0], p[1]));
    pen.stroke();
  };
  let scale = 1, width = 1, tall = 1;
  const screen = (r, u) => [width / 2 + scale * r, tall / 2 - scale * u];

  const ground = () => {
    pen.lineWidth = 1;
    pen.strokeStyle = "#d5d5d5";
    for (const rule of data.grid) line(rule.map((p) => project(...p)));
  };

  const draw = () => {
    const frame = move(now), ratio = window.devicePixelRatio || 1;
    width = canvas.clientWidth; tall = canvas.clientHeight;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(tall * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(tall * ratio);
    }
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, tall);
    scale = zoom * Math.min(width, 1.6 * tall) / size;
    ground();
    for (let k = 0; k < points; k++) [right[k], up[k], near[k]] = project(x[k], y[k], z[k]);
    for (let k = 0; k < depth.length; k++) {
      depth[k] = near[triangles[3 * k]] + near[triangles[3 * k + 1]] + near[triangles[3 * k + 2]];
    }
    order.sort((a, b) => depth[a] - depth[b]);
    pen.lineWidth = 0.7;
    for (const k of order) {
      const [a, b, c] = triangles.subarray(3 * k, 3 * k + 3);
      const mean = (colour[frame * points + a] + colour[frame * points + b] + colour[frame * points + c]) / 3;
      pen.fillStyle = pen.strokeStyle = data.colours[Math.round(mean * (data.colours.length - 1) / 255)];
      pen.beginPath();
      for (const corner of [a, b, c]) pen.lineTo(...screen(right[corner], up[corner]));
      pen.closePath();
      pen.fill();
      pen.stroke();
    }
    pen.lineWidth = 1;
    pen.strokeStyle = "#222";
    for (let k = 0; k < edges.length; k += 2) {
      line([[right[edges[k]], up[edges[k]]], [right[edges[k + 1]], up[edges[k + 1]]]]);
    }
    at("clock").textContent = `t = ${(data.start + now * data.dt).toFixed(data.digits)} ${data.time}`;
    if (document.activeElement !== at("time")) at("time").value = 1000 * now / span;
  };

  const tick = (time) => {
    if (playing) {
      now = (now + Math.min(time - last, 100) * (frames - 1) / data.periods / 3000) % span;
      draw();
    }
    last = time;
    requestAnimationFrame(tick);
  };

  const turnBy = (dx, dy) => {
    yaw += dx;
    pitch = Math.min(Math.PI / 2, Math.max(0.05, pitch + dy));
    draw();
  };
  const keys = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] };
  canvas.addEventListener("keydown", (e) => { if (keys[e.key]) { e.preventDefault(); turnBy(...keys[e.key]); } });
  canvas.addEventListener("pointerdown", (e) => canvas.setPointerCapture(e.pointerId));
  canvas.addEventListener("pointermove", (e) => { if (e.buttons) turnBy(e.movementX / 150, e.movementY / 150); });
  canvas.addEventListener("wheel", (e) => {
    e.preventDefault();
    zoom = Math.min(8, Math.max(0.4, zoom * Math.exp(-e.deltaY / 600)));
    draw();
  }, { passive: false });
  const setPlaying = (on) => { playing = on; at("play").textContent = on ? "Pause" : "Play"; };
  at("play").addEventListener("click", () => setPlaying(!playing));
  at("time").addEventListener("input", (e) => { setPlaying(false); now = Math.min(e.target.value / 1000 * span, span - 1e-6); draw(); });
  at("factor").addEventListener("input", (e) => { height = +e.target.value; at("times").textContent = height; draw(); });
  window.addEventListener("resize", draw);
  at("heights").hidden = flat;
  at("sheet").hidden = false;
  setPlaying(playing);
  draw();
  requestAnimationFrame(tick);
})();
