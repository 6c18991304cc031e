# SPDX-License-Identifier: Apache-2.0
# Inputs of the commands that are put under faults, into ../in.
set -eu
cd ../in
cat >torque.csv <<'END'
time,steer_torque
0,0
0.1,0.1
2,0
END
cat >sweep.yml <<'END'
bicycle: roadster
sweep:
  speed: [5, 6]
  parts.rider.mass: {normal: [70, 5]}
seed: 1
draws: 2
outputs: [weave_speed, stable_ranges, eps_max, outcome, time]
ride: {time: 5}
END
bicycle sweep sweep.yml -o swept --threads 1 >said
bicycle mujoco mjcf benchmark -o benchmark.xml
cat >top.xml <<'END'
<mujoco model="coin">
  <custom><tuple name="rolling_discs">
    <element objtype="body" objname="coin" prm="0.1"/>
  </tuple></custom>
  <worldbody><body name="coin" pos="0 0 0.1"><freejoint/>
    <geom type="cylinder" size="0.1 0.005" mass="1" euler="90 0 0" contype="0" conaffinity="0"/>
  </body></worldbody>
</mujoco>
END
cat >small.yml <<'END'
title: A short ride with all layers
bicycle: benchmark
start: {speed: 5, lean_rate: 0.1}
duration: 0.2
sample: 0.02
instants: {count: 3, seed: 1, lean: 0.3, steer: 0.3, rate: 1, slow: 3, fast: 7}
reference: {engine: analytic}
candidate: {engine: mujoco, integrator: rk4, timestep: 1e-3, root: hinge}
linear: {speeds: [4, 6], count: 2}
convergence: {timesteps: [2e-2, 1e-2, 5e-3, 2.5e-3], tolerance: 1e-6}
gates:
  - layer: L2
    metric: max
    signals: [lean, steer]
    limit: 1e-6
    reason: rad; loose
  - layer: L0
    metric: relative
    limit: 1e-6
    reason: loose
  - layer: Lp
    metric: relative
    limit: 1e-6
    reason: loose
  - layer: L4
    metric: order_error
    limit: 1
    reason: loose
END
bicycle validate small.yml -o report >said
sed 's/speed: 5,/speed: 6,/' small.yml >other.yml
sed 's/draws: 2/draws: 500/; s/time: 5/time: 20/' sweep.yml >many.yml
