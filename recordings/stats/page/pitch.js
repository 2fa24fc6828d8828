// The pitch: grass, lines, areas and goals, x to the right and y up, in m of the field frame.

/** Puts a canvas in order for the width it has, and gives a context in which one unit is a metre of the pitch. */
export function fitted(canvas, pitch, margin) {
  const wide = pitch.length + 2 * margin, high = pitch.width + 2 * margin;
  const width = canvas.clientWidth || canvas.parentElement.clientWidth || 320;
  const density = window.devicePixelRatio || 1;
  const scale = width / wide;
  canvas.style.height = `${high * scale}px`;
  canvas.width = Math.round(width * density);
  canvas.height = Math.round(high * scale * density);
  const context = canvas.getContext("2d");
  const unit = canvas.width / wide;
  context.setTransform(unit, 0, 0, -unit, (wide / 2) * unit, (high / 2) * unit);
  return context;
}

/** Grass, darker around the lines, in mown stripes unless `plain`. */
export function drawGrass(context, pitch, plain = false) {
  const { length, width } = pitch;
  context.fillStyle = plain ? "#12241b" : "#275c41";
  context.fillRect(-length, -width, 2 * length, 2 * width);
  if (plain) return;
  const stripes = 11;
  for (let number = 0; number < stripes; number += 1) {
    context.fillStyle = number % 2 ? "#2f6f4e" : "#33775a";
    context.fillRect(-length / 2 + (number * length) / stripes, -width / 2, length / stripes + 0.01, width);
  }
}

/** All lines, and the goals. */
export function drawLines(context, pitch, colour = "#eef4ef", thickness = 0.07) {
  const { length, width } = pitch;
  context.strokeStyle = colour;
  context.lineWidth = thickness;
  context.strokeRect(-length / 2, -width / 2, length, width);
  line(context, 0, -width / 2, 0, width / 2);
  circle(context, 0, 0, pitch.centre_circle_radius);
  for (const end of [-1, 1]) {
    const x = (end * length) / 2;
    for (const area of ["penalty", "goal"]) {
      const depth = pitch[`${area}_area_depth`], span = pitch[`${area}_area_width`];
      context.strokeRect(Math.min(x, x - end * depth), -span / 2, depth, span);
    }
    context.strokeStyle = "#ffffff";
    context.lineWidth = thickness * 1.5;
    context.strokeRect(Math.min(x, x + end * pitch.goal_depth), -pitch.goal_width / 2, pitch.goal_depth, pitch.goal_width);
    context.strokeStyle = colour;
    context.lineWidth = thickness;
    context.fillStyle = colour;
    disc(context, end * (length / 2 - pitch.penalty_mark), 0, thickness);
    for (const y of [-width / 2, width / 2]) {
      const from = Math.atan2(-Math.sign(y), 0), to = Math.atan2(0, -end);
      const clockwise = end * Math.sign(y) > 0;
      context.beginPath();
      context.arc(x, y, pitch.corner_arc_radius, from, to, clockwise);
      context.stroke();
    }
  }
}

export function line(context, x1, y1, x2, y2) {
  context.beginPath();
  context.moveTo(x1, y1);
  context.lineTo(x2, y2);
  context.stroke();
}

export function circle(context, x, y, radius) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.stroke();
}

export function disc(context, x, y, radius) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.fill();
}
