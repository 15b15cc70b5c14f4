"""A client of Catalyst Live, to be run by pvpython: python live_client.py PORT. Says in a line each what happens."""
import sys
import time

from paraview import live
from paraview.simple import FindSource

updates, closed = 0, False


def say(*words):
    print("client:", *words, flush=True)


def connected(link, event):
    say("connected")
    live.ExtractCatalystData(link, "particles")
    live.ProcessServerNotifications()


def updated(link, event):
    global updates
    source = FindSource("particles")
    points = source.GetDataInformation().GetNumberOfPoints() if source else 0
    if points:
        updates += 1
        if updates == 1:
            say("points", points, *sorted(source.PointData.keys()))
        if updates == 10:
            say("updated ten times")


def disconnected(link, event):
    global closed
    closed = True
    say("closed")


link = live.ConnectToCatalyst("localhost", int(sys.argv[1]))
for name, action in (("ConnectionCreatedEvent", connected), ("UpdateEvent", updated), ("ConnectionClosedEvent", disconnected)):
    link.AddObserver(name, action)
say("listening")
give_up = time.monotonic() + 60
while not closed and time.monotonic() < give_up:
    live.ProcessServerNotifications()
    time.sleep(0.01)
