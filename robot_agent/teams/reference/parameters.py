"""Every number of the reference team, with its unit and its reason. Nothing else in the team is tuned.

Distances are between centres unless a name says otherwise. A variant of the team is
`dataclasses.replace(PARAMETERS, support_speed=2.5)`, given to `Reference`.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Parameters:
    """The numbers of one team."""

    # Shared estimate
    told_age: float = 0.6
    """s; an opponent that a teammate reported longer ago has moved more than its own width."""
    same_robot: float = 0.9
    """m; two reports closer than this are of one robot: the noise at 7 m, and 0.1 s of motion."""
    silent_delay: float = 1.5
    """s that count against a teammate without radio messages: it is believed at its home, and may not be there."""
    silent_after: float = 0.3
    """s without any message, after which each robot plays the ball in its own part of the pitch: three messages."""

    # Roles
    stays: float = 0.4
    """s by which another robot must be at the ball earlier to take the ball over: radio age and noise."""
    receives: float = 1.2
    """s in favour of the robot that was promised a pass: as long as a pass rolls."""
    keeps_place: float = 1.5
    """m by which another robot must be nearer to a place than the one that has it."""

    passes_by: float = 0.05
    """m of air at which a robot passes others on its way to the ball."""
    meets_ahead: float = 0.3
    """s before a rolling ball that a robot is where it meets it, turned to it: one that comes at the same time from the
    side pushes the ball on. In self-play, 12 halves of 150 s each, the ball was in play 60 % of the time without and
    71 % with it."""
    meets_ahead_fast: float = 1.0
    """m/s of a ball for which that matters."""
    meets_ahead_free: float = 1.5
    """m from the meeting to any opponent: with one nearer, the first to touch the ball has it."""
    has_it: float = 0.6
    """m; a robot this close to the ball has it."""

    # Places
    looks_ahead: float = 0.6
    """s of the ball's roll; places are around where it is then."""
    support_near: float = 3.2
    """m from the ball to a near supporter: outside the reach of the opponent at the ball."""
    support_far: float = 5.5
    """m from the ball to a far supporter: a pass of 1.2 s."""
    support_apart: float = 3.0
    """m between two supporters, so that one opponent cannot cover both."""
    support_sticks: float = 0.1
    """Value of a place a metre that a robot does not have to drive: keeps the distance of a match short."""
    support_ahead: float = 0.06
    """Value of a place a metre ahead of the ball: a goal needs a pass that is received in the other half."""
    support_inset: float = 0.65
    """m from the lines to a supporter: a pass that it misses by less stays on the pitch."""
    support_lane: float = 0.6
    """Value of a place to which a pass arrives surely."""
    support_worth: float = 1.2
    """Value of a place for each of its worth."""
    support_most_ahead: float = 3.0
    """m ahead of the ball, or behind it, that count at most."""
    support_speed: float = 1.3
    """m/s; supporters walk, as the ball is faster than they are anyway. In self-play, 12 halves of 150 s, robots drove
    636 m in ten minutes with 1.6, 600 with 1.3, 559 with 1.0 and 531 with 0.8; below 1.3, `simple` scored more."""
    clears_within: float = 1.5
    """m from the ball, within which a supporter makes room at full speed."""
    settles: float = 2.5
    """m by which a place has to move before a robot follows it: the ball moves to and fro, robots need not."""
    taken_within: float = 0.8
    """m from a place to the teammate that has it, so that no other robot may keep it."""
    serves_near: float = 2.4
    """m from ball and teammates, beyond which a supporter stays where a pass reaches it."""
    serves_far: float = 7.5
    """m from the ball, up to which it stays."""
    serves_behind: float = 1.5
    """m behind the ball, up to which it stays."""
    guard_speed: float = 2.0
    """m/s of the guard: with 1.0, as supporters walk, `simple` scored twice as often."""
    settles_guard: float = 1.5
    """m of the same for the guard."""
    settles_close: float = 0.4
    """m of the same for a robot that blocks or marks."""
    serves_chance: float = 0.5
    """Least chance of a pass to where it stays."""
    guard_share: float = 0.42
    """Where the guard stands between the own goal and the ball, as a share."""
    guard_farthest: float = 7.0
    """m from the own goal to the guard at most."""
    defends_apart: float = 1.4
    """m between guard, blocker and ball: before the penalty area all of their places would be the same."""
    block_distance: float = 2.2
    """m from an opponent's ball to the robot that blocks its way to the goal."""
    mark_distance: float = 0.9
    """m from a marked opponent, toward the ball: as near as no contact allows."""

    mark_lane: float = 0.6
    """Where a marker stands: this part on the way of the pass, the rest on the way to our goal."""
    marks_beyond: float = 1.5
    """m from the ball, beyond which an opponent is without it."""
    marks_within: float = 2.5
    """m ahead of the middle line, up to which such opponents are marked."""
    blocks_before: float = 2.0
    """m; an opponent with the ball is blocked once the ball is behind this x."""
    marks_before: float = -1.0
    """m; opponents without the ball are marked once the ball is behind this x."""

    attack_lasts: float = 0.8
    """s for which the places of an attack stay after the ball is contested or between two holders."""

    # Passes
    pass_least: float = 1.6
    """m; a shorter pass does not roll the metre that counts."""
    pass_longest: float = 9.5
    """m; a longer pass takes over 2 s."""
    pass_inset: float = 1.0
    """m from the lines to the target of a pass: a receiver that misses it by less keeps it on the pitch."""
    pass_mean_speed: float = 3.6
    """m/s of a pass over its way, with `pass_arriving` at its end."""
    pass_drive: float = 0.4
    """Part of `dribble_speed` at which a robot drives toward the target while it turns to it."""
    pass_late: float = 0.2
    """Least chance of a pass for a robot that has to give up the ball."""
    receiver_notices: float = 0.4
    """s for which a receiver goes on as it does: radio, decision, and change of its motion."""
    receiver_runs: float = 2.0
    """m/s of a receiver that moves into a pass."""
    pass_arriving: float = 2.8
    """m/s when it arrives: the dribbler keeps it, and opponents have little time."""
    pass_error: float = 0.35
    """m beside the receiver at most: it moves as far while the ball rolls, and a kick that waits is lost."""
    intercept_reach: float = 0.45
    """m beside a lane within which an opponent has the ball without moving: hull, ball and noise."""
    intercept_speed: float = 1.3
    """m/s at which an opponent closes a lane, after its reaction."""
    intercept_reaction: float = 0.25
    """s until an opponent moves for a pass."""
    lane_sure: float = 0.9
    """m of margin with which a pass is sure to arrive."""
    lead: float = 1.2
    """m ahead of a receiver that a through ball is played."""
    lead_aside: float = 1.3
    """rad from the direction of the ball to a pass beside the receiver."""
    worth_range: float = 6.0
    """m to their goal over which the ball's worth falls to a third."""
    worth_free: float = 0.04
    """Worth a metre of room around the ball."""
    worth_room: float = 3.0
    """m of room that count at most."""
    prepared: float = 0.6
    """m into the other half, where a pass that is received makes a goal count: noise and the ball's roll."""
    pass_bonus: float = 0.12
    """Value of a pass besides its progress: the ball moves faster than robots, and opponents have to turn."""
    pass_prepares: float = 0.25
    """Value of a pass into the other half, without which a goal would not count."""
    turn_rate: float = 2.8
    """rad/s of a turn with the ball."""
    at_ball: float = 0.5
    """m from the ball to an opponent that fights for it."""
    comes_speed: float = 2.5
    """m/s at which an opponent comes."""
    wins_duel: float = 0.8
    """s after which an opponent at the ball surely has it."""
    turn_cost: float = 0.04
    """Value a radian of turning: an opponent comes nearer meanwhile."""
    chosen_bonus: float = 0.12
    """Value in favour of what was decided before: two equal choices would alternate with the noise."""
    chosen_near: float = 1.5
    """m; a target this close to the chosen one is the same: more than `lead`."""
    loss: float = 0.1
    """Value of the ball in the opponents' hold, at the middle of the pitch; twice as much at our goal line."""
    loss_near: float = 0.9
    """The same beside it at our goal: a ball lost there is a shot."""
    loss_range: float = 4.5
    """m from our goal over which the latter falls to a third."""

    # The own third
    clears_before: float = -4.0
    """m; behind this x the ball must not be lost: of 33 shots of `early`, 26 came within 10 s of that."""
    clears_to: float = -3.0
    """m; the least x to which a pass leads out of there."""
    clear_pressed: float = 2.5
    """m to an opponent within which the ball is kicked away where no pass leads out; with more room it is carried."""
    clear_sure: float = 0.7
    """Least chance with which it gets through its first `clear_lane`: beyond, a ball that is lost costs little."""
    clear_lane: float = 6.0
    """m of its way that a ball is kicked away through, along the ground."""
    clear_room: float = 0.7
    """m to the nearest opponent beside it with which it gets through."""
    clear_far: float = 14.0
    """m that a ball is kicked away at most."""
    clear_turn: float = 2.0
    """m that a radian of turning costs."""
    clear_cosine: float = 0.4
    """Cosine of the angle between kick axis and pitch, below which a robot turns before it kicks the ball away."""
    clear_error: float = 0.15
    """m beside the target, for each m to it, with which a ball is kicked away."""

    # Give and go
    run_passes: float = 3.0
    """m ahead, within which an opponent makes a robot that has passed run on past it."""
    run_beside: float = 1.4
    """m beside that opponent: to its way past it, and of an opponent that is in the way."""
    run_beyond: float = 2.5
    """m beyond it, where the run ends."""
    run_lasts: float = 2.0
    """s: a pass there, a moment, and the pass back."""

    # Shots
    shot_range: float = 7.0
    """m; from farther away a keeper has the time to move: by drill, no shot on the run from 5.5 m or more scored."""
    shot_margin: float = 0.36
    """m between a shot and an opponent's centre that its hull and the ball need."""
    shot_open: float = 0.4
    """m of air beside all opponents; more makes a shot no surer."""
    shot_spread: float = 0.1
    """m of air with which a shot scores three times of four; without any it scores every other time."""
    shot_speed: float = 7.4
    """m/s of a shot along the ground, on average over 5 m: it leaves with 10 m/s, a tick late, and slides."""
    shot_crossing: float = 2.5
    """m/s² with which an opponent then moves: what a robot's grip allows. Of 103 shots of random length and direction
    past a lone keeper that had any room by these numbers, 100 scored; of 348 that lacked 0.2 m, 27."""
    shot_turn: float = 0.3
    """m of room that a radian of turning costs: of two open corners, noise would choose another one in each tick."""
    lob_nearest: float = 3.4
    """m; a nearer lob is still rising over the bar."""
    lob_rises: float = 1.6
    """m after which a lob is above all hulls."""
    lob_room: float = 0.5
    """m beside a lob's path while it rises, without an opponent's centre."""
    lob_value: float = 0.9
    """Share of lobs that score over a keeper that is off its line, by drill: 8 of 8, from 5 to 7 m."""
    lob_on_line: float = 0.06
    """Share of lobs that score past a keeper on its line, by drill: 3 of 48, all of them from the side."""
    off_line: float = 0.45
    """m before the goal line, from where a keeper is too far out for a lob: hulls are 0.8 m high."""
    keeper_unseen: float = 3.5
    """m; from farther away a goal without a visible keeper is believed to have one: others may hide it."""
    shot_worth: float = 0.2
    """Least chance of a goal for which a robot under pressure shoots."""
    shot_waits: float = 0.93
    """The same for a robot with room: closer to the goal the chance grows within a second."""
    shot_pressed: float = 1.6
    """m to an opponent that is at the ball within half a second."""
    shot_keeps: float = 0.12
    """The same for a robot that aims at the goal already: noise would stop half of the shots."""
    shot_takes: float = 0.8
    """Part of the best shot's chance for which a shot along the kick axis is taken at once: the last 0.2 rad of a turn
    take 0.2 s, and opponents come."""
    shot_same: float = 0.15
    """m of room in favour of the target that was aimed at a tick ago."""
    shot_stays: float = 0.15
    """Chance in favour of the same kind of shot as a tick ago."""
    shot_least_cosine: float = 0.2
    """Cosine of the angle between kick axis and pitch, below which it does not point at the goal."""
    shot_late: float = 0.1
    """The same for a robot that has to give up the ball."""
    shot_drive: float = 0.5
    """Part of `dribble_speed` at which a robot drives toward the goal while it turns to it."""
    shot_error: float = 0.06
    """m beside the target at most."""

    # Dribbling
    dribble_speed: float = 3.0
    """m/s with the ball; the dribbler keeps it in turns of 3 rad/s."""
    dribble_step: float = 2.0
    """m ahead that a dribble is judged by."""
    dribble_aims: float = 1.5
    """m before their goal line, the point that a dribble is directed to: closer there is no room to shoot."""
    dribble_beside: float = 0.6
    """m from the touch line to the end of a dribble at least."""
    dribble_before: float = 1.2
    """m from their goal line to the same."""
    dribble_turn_cost: float = 0.02
    """Value a radian beside the way to the goal."""
    dribble_ends: float = 0.5
    """Part of the speed near the end of the dribbling circle, where the robot has to be able to stop."""
    dribble_room: float = 0.2
    """m of air between ball and opponents on the way."""
    pressed_cost: float = 0.1
    """Value of a dribble that is pressed less than of one that is not."""
    pressed: float = 1.1
    """m to an opponent ahead that presses."""
    patience: float = 3.0
    """s with the ball after which the best kick is taken, however poor."""

    # Keeper
    on_line: float = 0.0
    """m from the goal line to the keeper's centre. A lob passes 3 cm lower than the top of a hull only there."""
    before_posts: float = 0.05
    """m between the hull of a keeper that comes back from beside its goal and the posts."""
    flies_above: float = 0.4
    """m of the ball's centre: above it no dribbler holds the ball, and a keeper that comes out is passed over."""
    narrows_within: float = 3.4
    """m from the goal's middle to the ball, from where the keeper comes off its line: no lob comes from nearer."""
    narrows: float = 0.6
    """m that it comes out for each m that the ball is nearer."""
    narrows_most: float = 0.8
    """m that it comes out at most."""
    holds_within: float = 0.5
    """m from the ball to an opponent that holds it."""
    points_least: float = 0.5
    """Cosine of the angle between such an opponent's kick axis and the pitch, above which it points at the goal."""
    points_weight: float = 0.5
    """How far the keeper moves to where a kick would go, as a share: the axis is seen with an error of 0.2 rad."""
    comes_out: float = 3.0
    """m from the goal's middle up to which the keeper fetches a slow ball that it reaches first."""
    comes_out_slow: float = 1.5
    """m/s of a ball that the keeper fetches, at most."""
    lies_in_area: float = 0.5
    """m/s of a ball in the goal area that the keeper fetches, at most: opponents press, but may not enter."""
    shot_slowest: float = 1.0
    """m/s toward the goal; a slower ball is no shot."""
    shot_horizon: float = 2.5
    """s to the line; a later ball can wait."""
    crossing_gain: float = 8.0
    """1/s; full speed to a shot's crossing, easing off over the last centimetres."""
    rivals_run: float = 2.0
    """m/s of opponents that run for a ball before the goal."""
    first_by: float = 0.4
    """s that it has to be there before any opponent."""

    # Set pieces
    restart_wait: float = 2.0
    """s after START for a free receiver; then the ball is played anyway: opponents come nearer. The rules give 7 s."""
    penalty_corner: float = 0.35
    """Target of a penalty beside the goal's middle, as a share of the goal's width."""
    restart_sure: float = 0.75
    """Chance of arrival for which a set piece is played at once."""

    stepped_in: float = 0.55
    """m from the ball of a restart, from where the target stays: to turn with the ball would drag it."""

    # Opponents
    bump: float = 0.7
    """m/s at which it may touch an opponent: two that both do are below the 1.5 m/s of a charge (`charge_speed`)."""
    spares: float = 0.6
    """Part of the deceleration with which it brakes before an opponent, who comes nearer meanwhile."""

    # Recovery
    stuck_after: float = 0.8
    """s of the stuck flag after which a robot backs out."""
    stuck_turn: float = 2.2
    """rad from the obstacle to the direction in which it backs out."""
    stuck_out: float = 0.7
    """s that it backs out."""


PARAMETERS = Parameters()
