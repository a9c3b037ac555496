"""Checks the house rules on the sources: house.py ROOT. Prints what breaks them; exit status 1 if anything does.

- What a room includes of other rooms must be in the closure of what its chute_room(… LINKS …) line names.
- VTK's headers stay in the rooms that are there to hide them.
- No file of more than 500 lines.
- Every equation number of the thesis that a comment cites exists (equation_numbers.txt).
"""
import os
import re
import sys

root = os.path.normpath(sys.argv[1])
here = os.path.dirname(os.path.abspath(__file__))
MOST_LINES = 500
VTK_ROOMS = {"vtk", "io", "flat", "read", "write"}
# src/app is an executable, not a room, and the only place that sees both halves.
EVERYWHERE = {"app"}

problems = []


def complain(path, line, what):
    problems.append("%s:%d: %s" % (os.path.relpath(path, root), line, what))


def files(folder, *endings):
    for at, folders, names in os.walk(os.path.join(root, folder)):
        folders.sort()
        for name in sorted(names):
            if name.endswith(endings):
                yield os.path.join(at, name)


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


# Rooms, their folders and what they link
links, folder_of = {}, {}
for half in ("src", "render"):
    for path in files(half, "CMakeLists.txt"):
        for match in re.finditer(r"chute_room\(\s*(\w+)([^)]*)\)", re.sub(r"#.*", "", read(path))):
            name, rest = match.groups()
            words = rest.split()
            linked, taking = set(), False
            for word in words:
                if word in ("SOURCES", "LINKS", "LIBRARIES"):
                    taking = word == "LINKS"
                elif taking:
                    linked.add(word)
            links[name] = linked
            folder_of[os.path.dirname(path)] = name
for name in sorted(links):
    for linked in sorted(links[name] - links.keys()):
        problems.append("room %s links %s, which is no room" % (name, linked))


def closure(name):
    seen, todo = set(), [name]
    while todo:
        room = todo.pop()
        if room not in seen:
            seen.add(room)
            todo += links.get(room, ())
    return seen


for name in sorted(links):
    if any(name in closure(other) for other in links[name] if other in links):
        problems.append("room %s links itself in a circle" % name)

def room_at(folder):
    """The room of a folder that an #include names."""
    for half in ("src", "render"):
        if os.path.join(root, half, folder) in folder_of:
            return folder_of[os.path.join(root, half, folder)]
    return folder if folder in EVERYWHERE else None


# Includes
checked = 0
for half in ("src", "render"):
    for path in files(half, ".hpp", ".cpp", ".h", ".c", ".in"):
        room = folder_of.get(os.path.dirname(path)) or os.path.basename(os.path.dirname(path))
        allowed = closure(room) if room in links else set(links)
        if room not in links and room not in EVERYWHERE:
            complain(path, 1, "lies in no room: no chute_room(%s …) in its folder" % room)
        for number, line in enumerate(read(path).splitlines(), 1):
            vtk = re.match(r"\s*#\s*include\s*[<\"](vtk\w+\.h)[>\"]", line)
            if vtk and room not in VTK_ROOMS:
                complain(path, number, "%s: VTK belongs to %s" % (vtk.group(1), ", ".join(sorted(VTK_ROOMS))))
            own = re.match(r"\s*#\s*include\s*\"([\w./]+)/[\w.]+\"", line)
            if not own:
                continue
            checked += 1
            other = room_at(own.group(1))
            if other is None:
                complain(path, number, "%s: there is no room there" % own.group(1))
            elif other not in allowed | {room}:
                complain(path, number, "%s may not include %s: it does not link it" % (room, other))

# Lengths
for half in ("src", "render", "tests"):
    for path in files(half, ".hpp", ".cpp", ".h", ".c", ".py", "CMakeLists.txt"):
        count = read(path).count("\n")
        if count > MOST_LINES:
            complain(path, count, "has %d lines; %d are the most" % (count, MOST_LINES))

# Equations. A citation is a number like (2.13), or one of a range: (2.11) to (2.14).
known = set(read(os.path.join(here, "equation_numbers.txt")).split())
cited = 0
for half in ("src", "render"):
    for path in files(half, ".hpp", ".cpp"):
        for number, line in enumerate(read(path).splitlines(), 1):
            comments = [line.split("//", 1)[1]] if "//" in line else []
            comments += re.findall(r'"((?:[^"\\]|\\.)*)"', line)  # messages cite equations, too
            for comment in comments:
                for equation in re.findall(r"\((\d\.\d{1,2})[a-z]?\)", comment):
                    cited += 1
                    if equation not in known:
                        complain(path, number, "the thesis has no equation (%s)" % equation)

# A check that saw nothing is no check.
if len(links) < 8 or checked < 50 or cited < 20:
    problems.append("only %d rooms, %d includes, %d citations seen: is ROOT right?" % (len(links), checked, cited))
for problem in problems:
    print(problem)
print("%d rooms, %d includes, %d citations; %d problems" % (len(links), checked, cited, len(problems)))
sys.exit(1 if problems else 0)
