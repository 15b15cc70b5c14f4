"""Catalyst scripts and a short run that several tests use."""
SHORT = {"resolution.spacing": "4mm", "time.end": "10us", "insitu.frames": 3, "insitu.max_share": 1,
         "insitu.image_width": 320, "insitu.image_height": 240}
HEAD = """# script-version: 2.0
from paraview import catalyst
import ejecta_view as ejecta
options = catalyst.Options()
source = ejecta.channel("{channel}")
def catalyst_execute(info):
"""
# Writes what it is told into a file of each call.
WRITES = HEAD + """    with open(f"{{ejecta.settings()['run_folder']}}/images/{name}_{{info.timestep:06d}}.txt", "w") as out:
        print({what}, file=out)
"""
