// The words of the test mode: what each does, and which fields of an order it needs.

/** Word → what it is called, one sentence, and its fields of the order. */
export const TESTS = {
  stop: ["Stop", "All robots of the side stand still.", []],
  location: ["Location", "Robot A goes to point A, turns by angle A, and says where it believes to be.", ["robot_a", "point_a", "angle_a"]],
};

/** All fields of an order that a form can fill in: word, kind, and unit. */
export const FIELDS = {
  robot_a: ["Robot A", "robot"],
  robot_b: ["Robot B", "robot"],
  point_a: ["Point A", "point"],
  point_b: ["Point B", "point"],
  angle_a: ["Angle A", "angle"],
  angle_b: ["Angle B", "angle"],
  kick_speed: ["Kick speed", "number", "m/s", 40],
  max_speed: ["Speed at most", "number", "m/s", 20],
  max_turn_rate: ["Turn rate at most", "number", "rad/s", 50],
};
