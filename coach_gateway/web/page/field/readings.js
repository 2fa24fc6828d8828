// What the chosen robot reads by its sensors: beams to what they met, touched sectors, the measured heading.

import { drawnRadius } from "../shared/bodies.js";
import { SIDES } from "../shared/palette.js";
import { line } from "../shared/shapes.js";

const TOUCH = "#ff5a4d";
const NEEDLE_M = 1.2;
const FAINT = 0.45;

/** Kind → how a reading is drawn, at the robot's place; `radius` is that of the drawn robot, in pixels. */
const KINDS = {
  range(context, projection, { robot, reading, sensor }) {
    if (sensor === undefined) return; // a robot that came after the setup
    const eye = ahead(ahead(robot, robot.heading, sensor.x), robot.heading + Math.PI / 2, sensor.y);
    const step = sensor.span / sensor.beams; // those of the reading are rounded
    context.globalAlpha = FAINT;
    reading.distances.forEach((away, beam) => {
      if (away === null) return;
      const angle = robot.heading + sensor.heading + (beam + 0.5) * step - sensor.span / 2;
      line(context, projection, eye, ahead(eye, angle, away));
    });
  },
  compass(context, projection, { robot, reading }) {
    line(context, projection, robot, ahead(robot, reading.heading, NEEDLE_M));
  },
  contact(context, projection, { robot, reading, radius }) {
    const width = (2 * Math.PI) / reading.touched.length;
    context.strokeStyle = TOUCH;
    context.lineWidth = 4;
    reading.touched.forEach((touched, sector) => {
      if (!touched) return;
      const start = projection.angle(robot.heading + (sector + 0.5) * width);
      context.beginPath();
      context.arc(projection.x(robot.x), projection.y(robot.y), 1.4 * radius, start, start + width);
      context.stroke();
    });
  },
};

export class Readings {
  #newest = {};
  #time = 0;

  /** Keeps the readings of a world: not every world has some. */
  note({ time, sensors = {} }) {
    if (time < this.#time) this.#newest = {};
    this.#time = time;
    for (const [name, readings] of Object.entries(sensors)) this.#newest[name] = { ...this.#newest[name], ...readings };
  }

  /** Draws the newest readings of one robot. */
  draw(context, projection, match, name, robot) {
    const sensors = match.sensorsOf(name), radius = drawnRadius(projection, match.radiusOf(name));
    for (const [sensor, reading] of Object.entries(this.#newest[name] ?? {})) {
      context.save();
      context.strokeStyle = SIDES[match.sideOf(name)].line;
      context.lineWidth = 1.2;
      KINDS[reading.kind]?.(context, projection, { robot, reading, sensor: sensors[sensor], radius });
      context.restore();
    }
  }
}

/** The point `away` metres from another in a direction of the field. */
const ahead = ({ x, y }, angle, away) => ({ x: x + away * Math.cos(angle), y: y + away * Math.sin(angle) });
