// The tests of a coach's order: what each does, and which fields of the order it has.

const MOTION = ["max_speed", "max_turn_rate"];

/** Test → its name, one sentence, the fields that it needs, and those that it may have. */
export const TESTS = {
  move: ["Move", "Robot A drives to point A, and faces angle A.", ["robot_a", "point_a"], ["angle_a", "with_ball", "avoid", ...MOTION]],
  location: ["Location", "Robot A drives from point A to point B and back, again and again.", ["robot_a", "point_a", "point_b"], ["angle_a", "angle_b", "with_ball", "avoid", ...MOTION]],
  circle: ["Circle", "Robot A drives round point A.", ["robot_a", "point_a", "radius"], ["with_ball", "avoid", ...MOTION]],
  pass: ["Pass", "Robot A gets the ball, brings it to point A, and passes to robot B, which waits at point B.", ["robot_a", "robot_b"], ["point_a", "point_b", "kick_speed", "avoid", ...MOTION]],
  catch: ["Catch", "Robot A waits at point A, and stops the ball when it comes.", ["robot_a"], ["point_a", "angle_a", "avoid", ...MOTION]],
  shoot: ["Shoot", "Robot A gets the ball, brings it to point A, and kicks it at point B, or at the goal.", ["robot_a"], ["point_a", "point_b", "kick_speed", "kick_mode", "avoid", ...MOTION]],
  machine: ["Behaviour machine", "Robot A runs the paper’s behaviour machine once: it dribbles to point A, and comes back to point B.", ["robot_a"], ["point_a", "point_b", "kick_speed", ...MOTION]],
  stop: ["Stop", "All robots of the side stand still.", [], []],
};

/** Field of an order → its label, its kind, and the parameter of that kind. */
export const FIELDS = {
  robot_a: ["Robot A", "robot"],
  robot_b: ["Robot B", "robot"],
  point_a: ["Point A", "point"],
  angle_a: ["Angle A", "angle"],
  point_b: ["Point B", "point"],
  angle_b: ["Angle B", "angle"],
  radius: ["Radius (m)", "number", 20],
  kick_speed: ["Kick speed (m/s)", "number", 40],
  kick_mode: ["Kick", "word", ["ground", "lob", "loft"]],
  max_speed: ["Speed at most (m/s)", "number", 20],
  max_turn_rate: ["Turn rate at most (rad/s)", "number", 50],
  with_ball: ["with the ball", "switch"],
  avoid: ["avoid obstacles", "switch"],
};
