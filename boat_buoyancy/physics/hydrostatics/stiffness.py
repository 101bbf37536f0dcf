# Copyright 2026 boat_buoyancy maintainers
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.

"""Force, torque and hydrostatic stiffness of a boat in still water, at any attitude."""

import numpy as np

from ..boat.hull import LAWS
from ..boat.records import hull_view, readable
from ..forces.load import load_at
from ..forces.pressure import waterplane_sums
from ..forces.probe_laws import arm, slope, wetting
from ..rotation import rotation_matrix
from ..sea.waves import Sea

STILL_WATER = readable(Sea().record), Sea().table.tolist()


def still_load(boat, state):
    """Return the `Load` on a boat at one `State` in still water, and its probes' depths (n,) m."""
    load, hull = _still(boat, state)
    return load, np.array(hull.depths)


def hydrostatic_stiffness(boat, state):
    """
    Return K (3, 3) of a boat at one `State` in still water, N/m, N and N m per m and rad.

    By how much the force up and the torques about world x and y fall with heave and with turns
    about world x and y, all of the centre of mass: K = sum k g g^T + swing diag(0, 1, 1), where
    g = (1, y, -x), k the slope of a probe's force with its depth and x, y the place where the
    water's surface cuts it (of panels the integral over the waterplane, k = rho g dA); swing,
    sum F z over all lifts F and their heights z, is that of a pendulum.
    """
    load, hull = _still(boat, state)
    R = np.array(rotation_matrix(state.orientation.tolist()))
    if boat.hull.panels is not None:
        area, x, y, xx, yy, xy, swing = boat.hull.specific_weight * np.array(
            waterplane_sums(boat.plain_records[0], hull))
        K = np.array([[area, y, -x], [y, yy, -xy], [-x, -xy, xx]])
    else:
        law, cosine = LAWS.index(boat.hull.law), R[2, 2]
        probes = list(zip(boat.hull.height.tolist(), hull.depths))
        wet, share = np.transpose([wetting(law, *probe, cosine) for probe in probes])
        k = boat.hull.max_force * [slope(law, *probe, cosine) for probe in probes]
        along = np.array([arm(law, height, part, cosine)
                          for (height, _), part in zip(probes, wet.tolist())])
        center = boat.probe_offsets @ R.T + np.outer(along, R[:, 2])
        # Half the wet part of a column is between the point of force and the surface.
        half = 0.5 * wet * boat.hull.height * np.sign(cosine) * (boat.hull.law == 'column')
        x, y, _ = (center + np.outer(half, R[:, 2])).T
        rows = np.stack([np.ones_like(x), y, -x])
        K = rows * k @ rows.T
        swing = boat.hull.max_force * share @ center[:, 2]
    return K + swing * np.diag([0.0, 1.0, 1.0])


def _still(boat, state):
    hull = hull_view(boat, plain=True)
    load = load_at(boat.plain_records[0], hull, *STILL_WATER, state.position.tolist(),
                   state.orientation.tolist(), 0.0)
    return load, hull
