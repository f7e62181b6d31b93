# SPDX-License-Identifier: LGPL-2.1-or-later
"""A body as a mesh file of gmsh, format 2.2."""
import hexmesh


def write(path, body):
    """Write cells and all named faces; returns name -> boundary id (from 1)."""
    ids = {name: number for number, name in enumerate(body["faces"], 1)}
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes",
             str(len(body["nodes"]))]
    lines += [f"{number} {x:.16g} {y:.16g} {z:.16g}"
              for number, (x, y, z) in enumerate(body["nodes"], 1)]
    lines += ["$EndNodes", "$Elements"]
    elements = [(3, ids[name], [body["cells"][cell][corner]
                                for corner in hexmesh.FACES[face]])
                for name, faces in body["faces"].items()
                for cell, face in faces]
    elements += [(5, 0, corners) for corners in body["cells"]]
    lines.append(str(len(elements)))
    for number, (kind, tag, corners) in enumerate(elements, 1):
        nodes = " ".join(str(node + 1) for node in corners)
        lines.append(f"{number} {kind} 2 {tag} {tag} {nodes}")
    lines += ["$EndElements", ""]
    with open(path, "w") as file:
        file.write("\n".join(lines))
    return ids
