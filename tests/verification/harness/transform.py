"""The same problem seen from elsewhere: scenes turned by 90 degrees about z, (x, y) -> (-y, x), or in motion."""
import copy
import json
import re


def minus(value):
    """-value of a number or of a text with a unit ("3 m")."""
    if isinstance(value, (int, float)):
        return -value
    number, _, unit = value.partition(" ")
    return f"{-float(number)!r} {unit}"


def turned(scene):
    """A scene (as a dictionary) turned by 90 degrees."""
    scene = copy.deepcopy(scene)
    charge = [scene["charge"]] if "charge" in scene else []
    for body in [*scene.get("bodies", []), *scene.get("detonators", []), *charge]:
        for key in ("center", "axis", "velocity", "position", "end", "normal"):
            if key in body:
                x, y, *z = body[key]
                body[key] = [minus(y), x, *z]
        if "size" in body:
            x, y, *z = body["size"]
            body["size"] = [y, x, *z]
        if "profile" in body:
            body["profile"] = turned_profile(body["profile"])
    faces = {"x": "y", "y": "x", "x_min": "y_min", "x_max": "y_max", "y_min": "x_max", "y_max": "x_min"}
    boundary = scene["boundary"] = {faces.get(key, key): value for key, value in scene["boundary"].items()}
    if "min" in boundary:
        (x0, y0, *z0), (x1, y1, *z1) = boundary["min"], boundary.get("max", boundary["min"])  # none: upper faces are open
        boundary["min"], boundary["max"] = [minus(y1), x0, *z0], [minus(y0), x1, *z1]
    return scene


def turned_profile(profile):
    """Formulas of the old x and y, which are y and -x now."""
    def seen(formula):
        return re.sub(r"\b[xy]\b", lambda found: {"x": "(y)", "y": "(-x)"}[found[0]], str(formula))

    result = {}
    for key, value in profile.items():
        if not isinstance(value, list):
            result[key] = seen(value)
        elif value and key == "deviatoric_stress":
            xx, yy, xy, *out = map(seen, value)  # out of the plane: xz, yz
            result[key] = [yy, xx, f"-({xy})", *([f"-({out[1]})", out[0]] if out else [])]
        elif value:
            x, y, *z = map(seen, value)
            result[key] = [f"-({y})", x, *z]
    return result


def boosted(scene, axis, speed):
    """A scene with a speed [m/s] added along an axis."""
    scene = copy.deepcopy(scene)
    k = "xyz".index(axis)
    for body in scene["bodies"]:
        velocity = list(body.get("velocity", ["0 m/s"] * 3))
        velocity[k] = f"{float(velocity[k].split()[0]) + speed!r} m/s"
        body["velocity"] = velocity
        if body.get("profile", {}).get("velocity"):
            body["profile"]["velocity"][k] = f"({body['profile']['velocity'][k]}) + {speed!r}"
    return scene


def toml(scene):
    """TOML text of a dictionary of tables, lists of tables (bodies) and values."""
    def table(path, content):
        plain = {k: v for k, v in content.items() if not is_table(v)}
        text = "".join(f"{k} = {json.dumps(v)}\n" for k, v in plain.items())
        for key, value in content.items():
            name = f"{path}.{key}" if path else key
            if isinstance(value, dict):
                text += f"\n[{name}]\n" + table(name, value)
            elif is_table(value):
                text += "".join(f"\n[[{name}]]\n" + table(name, v) for v in value)
        return text

    def is_table(value):
        return isinstance(value, dict) or isinstance(value, list) and any(isinstance(v, dict) for v in value)

    return table("", scene)
