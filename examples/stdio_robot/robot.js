// A robot in JavaScript without packages: it gets the ball, carries it toward the goal, and shoots beside the keeper.
//
// Standard input: the briefing as a line of JSON, then each sight as a line. Standard output: one command a line for
// each sight. Messages for people go to standard error, the robot's log. docs/robot.md explains all of it.
"use strict";

const readline = require("readline");

const TOP_SPEED = 2.0; // m/s
const SHOOTING_DISTANCE = 5.0; // m from the goal line
const AIM = 0.05; // rad; a kick waits until the robot points this well

let briefing = null;

// An angle in rad as the same direction between -pi and pi.
function wrap(angle) {
  return Math.atan2(Math.sin(angle), Math.cos(angle));
}

// The drive toward a place in m that ends there at rest and facing `heading`, both in the team frame.
function driveTo(me, x, y, heading) {
  const distance = Math.hypot(x - me.x, y - me.y);
  const speed = Math.min(TOP_SPEED, 1.5 * distance);
  const direction = Math.atan2(y - me.y, x - me.x) - me.heading; // in the body frame: 0 is the kicking direction
  return {
    vx: speed * Math.cos(direction),
    vy: speed * Math.sin(direction),
    omega: Math.max(-4, Math.min(4, 3 * wrap(heading - me.heading))),
  };
}

// y of a place in the goal, on the side that is farther from the obstacle nearest to it.
function aimInGoal(sight, goalLine, goalWidth) {
  const near = sight.obstacles.filter((other) => goalLine - other.x < 2 && Math.abs(other.y) < goalWidth);
  return (near.length > 0 && near[0].y > 0 ? -1 : 1) * 0.35 * goalWidth;
}

// The command for a sight.
function act(sight) {
  const me = sight.self;
  const pitch = briefing.setup.pitch;
  const goalLine = pitch.length / 2; // our team attacks +x
  const command = { answers_tick: sight.tick, dribble: true };
  if (!sight.game.running || sight.game.phase.startsWith("their_")) return command; // rests: the drive's default
  if (sight.holding && me.x > goalLine - SHOOTING_DISTANCE) {
    const bearing = Math.atan2(aimInGoal(sight, goalLine, pitch.goal_width) - me.y, goalLine - me.x);
    command.drive = driveTo(me, me.x, me.y, bearing);
    if (Math.abs(wrap(bearing - me.heading)) < AIM && sight.kicker_ready) {
      command.kick = { mode: "ground", speed: 8.0 };
    }
  } else if (sight.holding) {
    command.drive = driveTo(me, goalLine - SHOOTING_DISTANCE + 1, 0, Math.atan2(-me.y, goalLine - me.x));
  } else {
    const ball = sight.ball || sight.game.spot; // before it is seen: where the referee has placed it
    if (ball) command.drive = driveTo(me, ball.x, ball.y, Math.atan2(ball.y - me.y, ball.x - me.x));
  }
  return command;
}

readline.createInterface({ input: process.stdin }).on("line", (line) => {
  const message = JSON.parse(line);
  if (briefing === null) {
    briefing = message;
    console.error(`${briefing.robot} plays for ${briefing.side}`); // console.log would write between the commands
  } else {
    process.stdout.write(JSON.stringify(act(message)) + "\n");
  }
});
