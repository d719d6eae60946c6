#!/usr/bin/env python3
"""A Digital Curling 3 client, written from the public description of the protocol; standard library only.

    digital_curling_client.py PORT [NAME [MISBEHAVIOUR]]

It plays by a simple plan on its own FCV1 and checks everything the server says: keys, types, turns, scores, hammer,
thinking time. On stdout it prints a JSON object a line: what it does, what it finds wrong, and at the end a summary. A
misbehaviour strikes in its first turn unless its name says otherwise; where it has to wait for the test it reads a line
from stdin.
"""
import json
import math
import socket
import sys

TEE_Y, HOUSE, RADIUS = 38.405, 1.829, 0.145
TEAMS = ("team0", "team1")
problems = []


def tell(**what):
    print(json.dumps(what), flush=True)


def check(holds, what):
    if not holds and what not in problems:
        problems.append(what)
        tell(problem=what)


# FCV1: the way of a stone from the hack, in steps of 20 ms.


def slide(vx, vy, ccw, until_y=None):
    """Where it is, and how fast, when it rests or passes a line."""
    x = y = 0.0
    dt = 0.02
    sign = 1.0 if ccw else -1.0
    while True:
        v = math.hypot(vx, vy)
        braking = 9.80665 * (0.00200985 / (v + 0.06385782) + 0.00626286)
        if v <= braking * dt:
            return x, y, 0.0
        turn = sign * 0.00820 * v ** -0.8 * dt
        c, s, k = math.cos(turn), math.sin(turn), (v - braking * dt) / v
        nx, ny = k * (c * vx - s * vy), k * (s * vx + c * vy)
        x += 0.5 * (vx + nx) * dt
        y += 0.5 * (vy + ny) * dt
        vx, vy = nx, ny
        if until_y is not None and y >= until_y:
            return x, y, math.hypot(vx, vy)


solved = {}


def draw_to(x, y, ccw):
    """The velocity at the hack that brings a stone to rest there."""
    key = (round(x, 2), round(y, 2), ccw)
    if key in solved:
        return solved[key]
    speed, angle = 2.4, 0.05 if ccw else -0.05
    for _ in range(12):
        gx, gy, _ = slide(speed * math.sin(angle), speed * math.cos(angle), ccw)
        if abs(gx - x) < 0.01 and abs(gy - y) < 0.01:
            break
        speed += (y - gy) / 28.0
        angle += (x - gx) / max(gy, 1.0)
    solved[key] = (speed * math.sin(angle), speed * math.cos(angle))
    return solved[key]


def hit(x, y, ccw, speed=3.0):
    angle = math.atan2(x, y) + (0.03 if ccw else -0.03)
    for _ in range(8):
        gx, gy, _ = slide(speed * math.sin(angle), speed * math.cos(angle), ccw, y)
        angle += (x - gx) / y
    return speed * math.sin(angle), speed * math.cos(angle)


def from_tee(stone):
    return math.hypot(stone["position"]["x"], stone["position"]["y"] - TEE_Y)


def score(stones):
    nearest = [min([from_tee(s) for s in stones[t] if s] + [HOUSE + RADIUS]) for t in TEAMS]
    return [sum(1 for s in stones[t] if s and from_tee(s) < nearest[1 - i]) for i, t in enumerate(TEAMS)]


def choose(state, me, shot_number):
    ccw = shot_number % 4 < 2
    others = [s for s in state["stones"][TEAMS[1 - me]] if s]
    mine = [s for s in state["stones"][TEAMS[me]] if s]
    nearest_other = min(others, key=from_tee, default=None)
    best_mine = min(map(from_tee, mine), default=9.0)
    if shot_number < 2:
        vx, vy = draw_to(0.3 * (1 - 2 * me), TEE_Y - 3.2, ccw)
    elif nearest_other and from_tee(nearest_other) < min(best_mine, HOUSE):
        vx, vy = hit(nearest_other["position"]["x"], nearest_other["position"]["y"] - 0.25, ccw)
    else:
        vx, vy = draw_to(0.15 * (shot_number % 5 - 2), TEE_Y + 0.1 * (shot_number % 3 - 1), ccw)
    return {"type": "shot", "velocity": {"x": vx, "y": vy}, "rotation": "ccw" if ccw else "cw"}


# What the server may say.


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def is_whole(value):
    return isinstance(value, int) and not isinstance(value, bool)


def check_stones(stones, where):
    check(set(stones) == set(TEAMS), where + ": teams")
    for team in TEAMS:
        check(len(stones[team]) == 8, where + ": eight stones a team")
        for stone in stones[team]:
            if stone is None:
                continue
            check(set(stone) == {"position", "angle"} and set(stone["position"]) == {"x", "y"}, where + ": a stone's keys")
            check(all(map(is_number, (stone["position"]["x"], stone["position"]["y"], stone["angle"]))), where + ": a stone's numbers")


def check_trajectory(trajectory):
    check(set(trajectory) == {"seconds_per_frame", "start", "finish", "frames"}, "trajectory: keys")
    check_stones(trajectory["start"], "trajectory.start")
    check_stones(trajectory["finish"], "trajectory.finish")
    now = {t: list(trajectory["start"][t]) for t in TEAMS}
    for frame in trajectory["frames"]:
        for change in frame:
            check(set(change) == {"team", "index", "value"}, "trajectory: a change's keys")
            check(change["value"] != now[change["team"]][change["index"]], "trajectory: a change that is none")
            now[change["team"]][change["index"]] = change["value"]
    return now


def check_dc(message):
    check(set(message) == {"cmd", "version", "game_id", "date_time"}, "dc: keys")
    check(message["version"]["major"] == 1 and is_whole(message["version"]["minor"]), "dc: version")


def check_is_ready(message):
    check(set(message) == {"cmd", "team", "game"} and message["team"] in TEAMS, "is_ready: keys")
    game = message["game"]
    check(set(game) == {"rule", "setting", "simulator", "players"} and game["rule"] == "normal", "is_ready: game")
    setting = game["setting"]
    check(set(setting) == {"max_end", "sheet_width", "five_rock_rule", "thinking_time", "extra_end_thinking_time"}, "is_ready: setting")
    check(is_whole(setting["max_end"]) and setting["five_rock_rule"] is True, "is_ready: ends and rule")
    check(all(is_number(setting[k][t]) for k in ("thinking_time", "extra_end_thinking_time") for t in TEAMS), "is_ready: times")
    check(game["simulator"] == {"type": "fcv1", "seconds_per_frame": 0.001}, "is_ready: simulator")
    for team in TEAMS:
        check(len(game["players"][team]) == 4, "is_ready: four players")
        for player in game["players"][team]:
            check(set(player) == {"type", "max_speed", "stddev_speed", "stddev_angle", "seed"}, "is_ready: a player's keys")
    return setting


class Follower:
    """Follows the game and finds what does not agree with the rules."""

    def __init__(self, setting):
        self.setting = setting
        self.before = None
        self.scores = []

    def update(self, message):
        check(set(message) == {"cmd", "next_team", "state", "last_move"}, "update: keys")
        state = message["state"]
        check(set(state) == {"end", "shot", "hammer", "stones", "scores", "extra_end_score", "thinking_time_remaining", "game_result"}, "state: keys")
        check_stones(state["stones"], "state.stones")
        over = state["game_result"] is not None
        check(is_whole(state["end"]) and is_whole(state["shot"]) and 0 <= state["shot"] <= 15, "state: end and shot")
        check((state["hammer"] is None) == over and (message["next_team"] is None) == over, "state: hammer and next team once it is over")
        if not over:
            hammer = TEAMS.index(state["hammer"])
            check(TEAMS.index(message["next_team"]) == (hammer if state["shot"] % 2 else 1 - hammer), "update: whose turn it is")
        for team in TEAMS:
            ends = state["scores"][team]
            check(len(ends) == self.setting["max_end"], "state: an entry for each end")
            check(all((points is None) == (i >= state["end"]) for i, points in enumerate(ends)), "state: null for ends not played")
        if self.before is None:
            check(message["last_move"] is None and state["hammer"] == "team1" and state["end"] == state["shot"] == 0, "the first update")
        else:
            self.step(state, message["last_move"], over)
        self.before = state

    def step(self, state, last, over):
        before = self.before
        check(last is not None and {"actual_move", "free_guard_zone_foul"} <= set(last), "last_move: keys")
        mover = TEAMS.index(before["hammer"]) if before["shot"] % 2 else 1 - TEAMS.index(before["hammer"])
        for i, team in enumerate(TEAMS):
            left, was = state["thinking_time_remaining"][team], before["thinking_time_remaining"][team]
            fresh = state["shot"] == 0 and state["end"] >= self.setting["max_end"]
            check(fresh or (left <= was if i == mover else left == was), "thinking time: only the mover's runs")
        if last["actual_move"]["type"] != "shot":
            return
        check(state["end"] * 16 + state["shot"] == before["end"] * 16 + before["shot"] + 1, "one shot further")
        check_trajectory(last["trajectory"])
        finish = last["trajectory"]["finish"]
        if last["free_guard_zone_foul"]:
            check(before["shot"] < 5, "a foul after the fifth stone")
            check(finish == before["stones"], "a foul puts all stones back")
        if state["shot"] != 0:
            check(finish == state["stones"], "the trajectory's end is the board")
            return
        points = score(finish)
        self.scores.append(points)
        for i, team in enumerate(TEAMS):
            if before["end"] < self.setting["max_end"]:
                check(state["scores"][team][before["end"]] == points[i], "the end's score")
        if not over:
            hammer = before["hammer"] if sum(points) == 0 else TEAMS[0 if points[1] else 1]
            check(state["hammer"] == hammer, "whose hammer it is")


class Line:
    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=600)  # robots throw in the meantime
        self.file = self.socket.makefile("r", encoding="utf-8", newline="\n")

    def hear(self):
        line = self.file.readline()
        return json.loads(line) if line else None

    def say(self, message):
        self.send((json.dumps(message) + "\n").encode())

    def send(self, data):
        self.socket.sendall(data)


def move(shot):
    return {"cmd": "move", "move": shot}


def raw(shot_text):
    return ('{"cmd":"move","move":' + shot_text + "}\n").encode()


def misbehave(kind, line, shot, port):
    """Returns whether the client plays on as if nothing had been."""
    if kind == "bad-json":
        line.send(b'{"cmd":"move","move":{"type":\n')
    elif kind == "wrong-cmd":
        line.say({"cmd": "ready_ok", "player_order": [0, 1, 2, 3]})
    elif kind == "late":
        tell(waits="to be late")
        sys.stdin.readline()
        line.say(move(shot))
    elif kind in ("vanish", "vanish-waiting"):
        line.socket.shutdown(socket.SHUT_RDWR)
        line.socket.close()
    elif kind == "huge-line":
        try:
            line.send(b'{"cmd":"move","move":"' + b"x" * 4000000)
        except OSError:
            pass
    elif kind == "nan":
        line.send(raw('{"type":"shot","velocity":{"x":NaN,"y":2.4},"rotation":"cw"}'))
    elif kind == "infinite":
        line.send(raw('{"type":"shot","velocity":{"x":0.1,"y":1e999},"rotation":"cw"}'))
    elif kind == "rotation":
        line.send(raw('{"type":"shot","velocity":{"x":0.1,"y":2.4},"rotation":"left"}'))
    elif kind == "out-of-turn":
        line.say(move({"type": "shot", "velocity": {"x": 0.1, "y": 2.4}, "rotation": "cw"}))
    elif kind == "two-moves":
        text = (json.dumps(move(shot)) + "\n").encode()
        line.send(text + text)
    elif kind == "twice":
        second = socket.create_connection(("127.0.0.1", port), timeout=60)
        tell(second_heard=len(second.recv(1000)))
        second.close()
        return True
    elif kind == "slow":
        data = (json.dumps(move(shot)) + "\n").encode()
        for byte in data[:10]:
            line.send(bytes([byte]))
            tell(sent="a byte")
            sys.stdin.readline()
    else:
        raise SystemExit("unknown misbehaviour " + kind)
    tell(done=kind)
    return False


def play(port, name, kind):
    if kind == "never":
        tell(done=kind)
        sys.stdin.readline()
        return
    line = Line(port)
    if kind == "silent":
        tell(done=kind)
        sys.stdin.readline()
        return
    check_dc(line.hear())
    line.say({"cmd": "dc_ok", "name": name})
    ready = line.hear()
    setting = check_is_ready(ready)
    me = TEAMS.index(ready["team"])
    line.say({"cmd": "ready_ok", "player_order": [0, 1, 3, 2]})
    new_game = line.hear()
    check(set(new_game) == {"cmd", "name"} and new_game["cmd"] == "new_game" and set(new_game["name"]) == set(TEAMS), "new_game")
    follower = Follower(setting)
    shots = 0
    while True:
        message = line.hear()
        if message is None:
            tell(end="the server hung up", shots=shots)
            return
        if message["cmd"] == "game_over":
            break
        check(message["cmd"] == "update", "cmd: update")
        follower.update(message)
        own = message["next_team"] == TEAMS[me]
        if kind in ("out-of-turn", "vanish-waiting") and not own and message["next_team"]:
            misbehave(kind, line, None, port)
            if kind == "vanish-waiting":
                return
            kind = None
        if own:
            if kind and not misbehave(kind, line, {"type": "shot", "velocity": {"x": 0.1, "y": 2.4}, "rotation": "cw"}, port):
                kind = None
                continue
            kind = None
            line.say(move(choose(message["state"], me, shots)))
            shots += 1
    line.socket.close()
    result = follower.before["game_result"]
    tell(end="game over", shots=shots, problems=problems, winner=result["winner"], reason=result["reason"], scores=follower.scores)


if __name__ == "__main__":
    try:
        play(int(sys.argv[1]), sys.argv[2] if len(sys.argv) > 2 else "python", sys.argv[3] if len(sys.argv) > 3 else None)
    except (BrokenPipeError, ConnectionError):
        sys.stdout = None  # whoever listened, or the server, has gone
