# script-version: 2.0
# Catalyst state generated using paraview version 5.11.0
import paraview
paraview.compatibility.major = 5
paraview.compatibility.minor = 11

#### import the simple module from the paraview
from paraview.simple import *
#### disable automatic camera reset on 'Show'
paraview.simple._DisableFirstRenderCameraReset()

# Create a new 'Render View'
renderView1 = CreateView('RenderView')
renderView1.ViewSize = [400, 300]
renderView1.InteractionMode = '2D'
renderView1.CameraPosition = [0.0, 0.0, 0.4]
renderView1.CameraFocalPoint = [0.0, 0.0, 0.0]
renderView1.CameraParallelScale = 0.06
SetActiveView(renderView1)

# create a new 'XML PolyData Reader'
particles = XMLPolyDataReader(registrationName='particles', FileName=['/home/user/run/export/particles_0.vtp'])
particles.PointArrayStatus = ['pressure', 'velocity']

# show data from particles
particlesDisplay = Show(particles, renderView1, 'GeometryRepresentation')
pressureLUT = GetColorTransferFunction('pressure')
pressureLUT.RGBPoints = [0.0, 0.23, 0.3, 0.75, 1e6, 0.86, 0.86, 0.86, 2e7, 0.7, 0.016, 0.15]
pressureLUT.ScalarRangeInitialized = 1.0
particlesDisplay.Representation = 'Point Gaussian'
particlesDisplay.ColorArrayName = ['POINTS', 'pressure']
particlesDisplay.LookupTable = pressureLUT
particlesDisplay.GaussianRadius = 0.001

# create extractor
pNG1 = CreateExtractor('PNG', renderView1, registrationName='PNG1')
pNG1.Trigger = 'TimeStep'
pNG1.Trigger.Frequency = 100
pNG1.Writer.FileName = 'RenderView1_{timestep:06d}{camera}.png'
pNG1.Writer.ImageResolution = [400, 300]
pNG1.Writer.Format = 'PNG'

vTP1 = CreateExtractor('VTP', particles, registrationName='VTP1')
vTP1.Trigger = 'TimeValue'
vTP1.Trigger.Length = 5e-6
vTP1.Writer.FileName = 'particles_{timestep:06d}.vtp'

SetActiveSource(particles)

# Catalyst options
from paraview import catalyst
options = catalyst.Options()
options.GlobalTrigger = 'TimeStep'
options.CatalystLiveTrigger = 'TimeStep'

if __name__ == '__main__':
    from paraview.simple import SaveExtractsUsingCatalystOptions
    SaveExtractsUsingCatalystOptions(options)
