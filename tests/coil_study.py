"""A study of two coils, whose exact field costs milliseconds, with every part that a study can have."""

RADIUS, THICKNESS = "actuator.coil_2.radius", "actuator.coil_2.thickness"
SPEC = f"""
[actuator]
kind = "coils"
name = "two coils"

[actuator.coil_1]
radius = "2 m"
half_height = "0.8 m"
thickness = "0.27 m"
current_density = "22.5 A/mm^2"

[actuator.coil_2]
radius = "3 m"
half_height = "0.3 m"
thickness = "0.25 m"
current_density = "-22.5 A/mm^2"

[operating_point]
line_radius = "10 m"
line_height = "10 m"
points_per_line = 5

[study]
objective = "maximise central_flux_density"

[[study.variables]]
key = "{RADIUS}"
lower = "2.6 m"
upper = "3.4 m"

[[study.variables]]
key = "{THICKNESS}"
lower = "0.1 m"
upper = "0.4 m"
resolution = "0.1 mm"

[[study.constraints]]
figure = "stray_flux_density"
upper = "1.5 mT"

[[study.sweeps]]
axes = [{{ key = "{RADIUS}", values = ["2.8 m", "3 m", "3.2 m"] }}]

[study.pareto]
against = "minimise stray_flux_density"
points = 3

[study.search]
algorithm = "auto"
max_evaluations = 60

[study.production]
samples = 500
tolerances = [
  {{ key = "{RADIUS}", tolerance = "10 mm" }},
  {{ key = "{THICKNESS}", plus = "5 mm", minus = "2 mm", distribution = "uniform" }},
]
"""
