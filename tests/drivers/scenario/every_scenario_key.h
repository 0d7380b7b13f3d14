#pragma once

#include <string>

namespace tubesight::drivers {
/// Every key, none at its default, as scenario_text() writes it. True numbers are sums of powers of
/// two: errors come back to the last bit.
inline const std::string kEveryKey = R"toml(format = 1

[scenario]
title = "every \"key\""
seed = 7
sheet_seed = 8

[camera]
width_px = 634
height_px = 480
scan = "odd-first"
focal_length_mm = 5.0625
cell_width_mm = 0.00841
cell_height_mm = 0.0098
sensor_columns = 768
frame_columns = 635
horizontal_scale = 1.03125
center_px = [324.375, 233.75]
distortion_per_mm2 = 0.0078125
distortion2_per_mm4 = -1e-05

[tool]
position_mm = [-3.125, 31.5, 112.75]
rotation_deg = [-0.125, -0.75, 48.0]

[tubesheet]
origin_mm = [1.5, -2.25]
row_step_mm = [0.0, 19.25]
column_step_mm = [11.125, 0.0]
bore_mm = 14.25
weld = "fillet"
rows = [-3, 120]
columns = [-4, 121]
addresses = "odd-sum"
odd_row_shift = -0.375
missing = [[1, 2], [3, 4]]
plugged = [[5, 6]]

[start]
)toml"
                                     "tubes = [{ row = 40, column = 61, at_px = [313.25, 196.0] }, "
                                     "{ row = 41, column = 60, at_px = [288.0, 230.0] }, "
                                     "{ row = 40, column = 63, at_px = [360.0, 190.0] }]\n"
                                     R"toml(window_px = [41, 37, 594, 329]
optimum_px = [300.5, 170.0]

[motion]
max_speed_mm_s = 251.5
max_acceleration_mm_s2 = 2001.0
max_height_speed_mm_s = 201.5
max_height_acceleration_mm_s2 = 1501.0
max_turn_speed_deg_s = 301.5
max_turn_acceleration_deg_s2 = 1201.0
max_lean_speed_deg_s = 21.5
max_lean_acceleration_deg_s2 = 501.0

[edges]
initial_threshold = 210
region_threshold = 61

[verification]
aligned_within_mm = 2.25
claim_within_s = 0.031
claim_oldest_s = 0.35

[calibration_error]
tool_position_mm = [0.5, -0.25, 0.125]
tool_rotation_deg = [0.5, 0.25, -0.25]
focal_length_mm = 0.125
center_px = [1.5, -2.0]
horizontal_scale = 0.0625
distortion_per_mm2 = 0.00390625
pitch_share = 0.0078125
bore_mm = 0.25

[sheet]
rolled = [[7, 8], [9, 10]]
flush = [[11, 12]]
voids = [[13, 14]]
displaced = [{ row = 15, column = 16, by_mm = [0.5, -0.25, 1.0] }]

[look]
plate = 0.5
gloss = 0.25
texture = 0.06
stains = 0.11
weld = 0.6
weld_mm = 1.3
fillet_mm = 3.5
fillet_height_mm = 2.5
land_mm = 1.1
wall = 0.06
bore_spread_mm = 0.05
nicked = 0.09
nick_mm = 1.1
boron = 0.1
plug = 0.5
plug_hole = 0.5
plug_height_mm = 4.0

[lamp]
lamp_permille = 900
pwm_hz = 120.0
lag_s = 0.25
ring = 0.125
ring_radius_mm = 36.0
below_tip_mm = 51.0
strength = 1.1
tilt_deg = 5.0
beam = 2.5
ambient = 0.05
led_radius_mm = 21.0
led_strength = 0.6

[sensor]
blur_px = 0.8
vignetting = 0.2
veil = 0.005
blooming = 0.2
blooming_px = 15.0
gain = 1.1
offset = 8.0
saturation = 250.0
shot_noise = 0.2
read_noise = 0.9
emi_share = 0.01
emi_amplitude = 21.0
salt_and_pepper = 0.001

[guidetube]
radius_mm = 9.0
length_mm = 34.0
reflectance = 0.4
shadow = 0.9

[video]
rate_hz = 25.0
exposure_s = 0.001
length_s = 3.0
window_margin_px = 20

[path]
at_mm = [680.5, 768.25]
height_mm = 61.0
heading_deg = 5.0
lean_deg = [0.25, -0.5]

[[step]]
rest_s = 0.25

[[step]]
to_mm = [702.5, 770.0]
profile = "s-curve"
speed_mm_s = 151.0
acceleration_mm_s2 = 1001.0
jerk_mm_s3 = 10001.0

[[step]]
height_mm = 50.0
profile = "s-curve"
speed_mm_s = 151.0
acceleration_mm_s2 = 1001.0
jerk_mm_s3 = 10001.0

[[step]]
dock_mm = 3.0
profile = "s-curve"
speed_mm_s = 151.0
acceleration_mm_s2 = 1001.0
jerk_mm_s3 = 10001.0

[[step]]
heading_deg = 6.0
profile = "s-curve"
speed_deg_s = 31.0
acceleration_deg_s2 = 121.0
jerk_deg_s3 = 1201.0

[[step]]
lean_deg = [1.0, -1.0]
profile = "s-curve"
speed_deg_s = 31.0
acceleration_deg_s2 = 121.0
jerk_deg_s3 = 1201.0

[[fault]]
kind = "dropped"
at_s = 0.125
for_s = 0.125

[[fault]]
kind = "repeated"
at_s = 0.125
for_s = 0.125

[[fault]]
kind = "torn"
at_s = 0.125
for_s = 0.125
share = 0.25

[[fault]]
kind = "swapped"
at_s = 0.125
for_s = 0.125

[[fault]]
kind = "black"
at_s = 0.125
for_s = 0.125
level = 5.0

[[fault]]
kind = "saturated"
at_s = 0.125
for_s = 0.125

[[fault]]
kind = "signal-loss"
at_s = 0.125
for_s = 0.125
damaged = true

[[fault]]
kind = "knock"
at_s = 0.125
for_s = 0.125
angle_deg = 0.25
axis = [1.0, 0.5, -0.25]

[[fault]]
kind = "lamp-out"
at_s = 0.125
for_s = 0.125
level = 0.5

[[fault]]
kind = "lamps-dead"
at_s = 0.125
for_s = 0.125
lamps = [1, 7, 12]

[[fault]]
kind = "lamp-drift"
at_s = 0.125
for_s = 0.125
level = 0.5

[[fault]]
kind = "vibration"
at_s = 0.125
for_s = 0.125
amplitude_mm = [0.25, 0.125, 0.0625]
amplitude_deg = [0.25, 0.125, 0.0625]
frequency_hz = 21.0

[[fault]]
kind = "cut"
at_s = 0.125
for_s = 0.125
counted = false

[[fault]]
kind = "jump"
at_s = 0.125
for_s = 0.125
steps = [2, -4]

[[fault]]
kind = "emi"
at_s = 0.125
for_s = 0.125
share = 0.25
amplitude = 50.0

[[fault]]
kind = "salt-pepper"
at_s = 0.125
for_s = 0.125
share = 0.25

[[fault]]
kind = "blots"
at_s = 0.125
for_s = 0.125
share = 0.0625

[[fault]]
kind = "reflections"
at_s = 0.125
for_s = 0.125
share = 0.0625

[[fault]]
kind = "ghost"
at_s = 0.125
for_s = 0.125
share = 0.25

[[fault]]
kind = "black-level"
at_s = 0.125
for_s = 0.125
level = 32.0
share = 0.75

[[fault]]
kind = "covered"
at_s = 0.125
for_s = 0.125
level = 170.0
share = 0.25
left = true

[[fault]]
kind = "frozen"
at_s = 0.125
for_s = 0.125

[[fault]]
kind = "other-camera"
at_s = 0.25
for_s = 0.125
steps = [2, -4]

[[fault]]
kind = "skip"
at_s = 0.125
for_s = 0.125

[[fault]]
kind = "pose-step"
at_s = 0.125
for_s = 0.125
by_mm = [0.125, -0.25, 3.5]
by_deg = [0.5, -0.5, 2.5]

[[fault]]
kind = "held"
at_s = 0.125
for_s = 0.125
share = 0.75
noise = 0.25

[[fault]]
kind = "compressed"
at_s = 0.125
for_s = 0.125
step = 6.0

[[fault]]
kind = "jitter"
at_s = 0.125
for_s = 0.125
waver_ms = 2.5

[[event]]
at_s = 0.5
kind = "claim"
tube = [40, 61]

[[event]]
at_s = 0.75
kind = "lamp"
lamp_permille = 800

[[event]]
at_s = 0.75
kind = "pose"

[[event]]
at_s = 1.0
kind = "pick"
at_px = [100.5, 200.25]

[[event]]
at_s = 1.25
kind = "acknowledge"

[expect]
answered = 0.5
missed = 0.25
end = "lost"
lost = "jump"
degraded = "few-tubes"
false_aligned = 1
contradicted = 2
confirmed = 3
tubes = 4
undetectable = true
)toml";

}  // namespace tubesight::drivers
