# SPDX-License-Identifier: Apache-2.0
"""The peers that live in Python: scipy's integrators over sympy's C, and numpy's eigenvalues.

A child of bicycle-bench. Reads one JSON request a line and answers with one JSON object a line,
{"error": "why"} where it cannot. Times are measured here, around the one call that is asked for, so
that neither pipes nor JSON count; they are the processor's time of this thread, as in the bench.

A ride by scipy is done in two ways:
  "lsoda", "dop853"                 scipy.integrate.ode with sympy's C handed over as a C function
                                    (a capsule): the Fortran integrator calls it directly
  "odeint"                          what most people write: a Python function that calls sympy's C
  "solve_ivp LSODA", "... DOP853"   through ctypes
"""
import ctypes
import json
import os
import sys
import time
import warnings

import numpy as np
import scipy
import scipy.integrate

SIZE = 5  # lean, steer, lean rate, steer rate, speed
DOUBLES = ctypes.POINTER(ctypes.c_double)


class Ride:
    """Ten seconds of sympy's bicycle."""

    def __init__(self, library, parameters, start, end, duration):
        self.flow = ctypes.CDLL(library)
        self.start, self.end, self.duration = np.array(start), np.array(end), duration
        values = (ctypes.c_double * len(parameters))(*parameters)
        if self.flow.sympy_flow_load(values, len(parameters)):
            raise ValueError("the library wants another number of parameters")
        self.flow.sympy_flow_calls.restype = ctypes.c_long
        self.flow.sympy_flow.restype = None
        self._own_function()
        self._capsule()

    def _capsule(self):
        make = ctypes.pythonapi.PyCapsule_New
        make.restype = ctypes.py_object
        make.argtypes = [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_void_p]
        self.function = make(ctypes.cast(self.flow.sympy_flow, ctypes.c_void_p), None, None)

    def _own_function(self):
        """Buffers are made once: the least that Python can do between integrator and C."""
        flow, y_here, dy_here = self.flow.sympy_flow, np.zeros(SIZE), np.zeros(SIZE)
        y_at, dy_at = (a.ctypes.data_as(DOUBLES) for a in (y_here, dy_here))

        def rates(_, y):
            y_here[:] = y
            flow(None, None, y_at, dy_at)
            return dy_here

        def rates_copied(_, y):
            return rates(_, y).copy()  # solve_ivp keeps what it is given

        self.rates, self.rates_copied = rates, rates_copied

    def ride(self, method, tolerance):
        if method in ("lsoda", "dop853"):
            solver = scipy.integrate.ode(self.function)
            solver.set_integrator(method, rtol=tolerance, atol=tolerance, nsteps=10**7)
            solver.set_initial_value(self.start, 0)
            return solver.integrate(self.duration)
        if method == "odeint":
            return scipy.integrate.odeint(self.rates, self.start, [0, self.duration], tfirst=True,
                                          rtol=tolerance, atol=tolerance, mxstep=10**7)[-1]
        _, name = method.split()
        return scipy.integrate.solve_ivp(self.rates_copied, (0, self.duration), self.start,
                                         method=name, rtol=tolerance, atol=tolerance).y[:, -1]

    def error(self, method, tolerance):
        difference = np.abs(self.ride(method, tolerance) - self.end)
        return float(np.max(difference)) if np.all(np.isfinite(difference)) else np.inf

    def tune(self, method, wanted):
        """The loosest tolerance on a grid of eight a decade whose ride ends within `wanted`, by
        bisection: errors fall with the tolerance, by and large."""
        good = lambda k: self.error(method, 10.0 ** (-k / 8)) <= wanted
        low = 8 * 5  # 1e-5 is too loose for all; at 1e-14 some refuse to start, so that the tight
        high = next((k for k in range(8 * 14, low, -4) if good(k)), None)  # end is looked for
        if high is None:
            raise ValueError(f"{method} does not reach an end error of {wanted:g}")
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (low, middle) if good(middle) else (middle, high)
        found = 10.0 ** (-high / 8)
        self.flow.sympy_flow_calls()
        error = self.error(method, found)
        return {"tolerance": found, "error": error, "evaluations": self.flow.sympy_flow_calls()}

    def repeat(self, method, tolerance, repeats):
        begin = time.thread_time()
        for _ in range(repeats):
            self.ride(method, tolerance)
        return {"seconds": time.thread_time() - begin}

    def evaluate(self, repeats):
        dy = (ctypes.c_double * SIZE)()
        begin = time.thread_time()
        self.flow.sympy_flow_repeat(self.start.ctypes.data_as(DOUBLES), dy, ctypes.c_long(repeats))
        return {"seconds": time.thread_time() - begin}


class Matrices:
    """Eigenvalues of many 4 x 4 matrices at once."""

    def __init__(self, rows):
        self.A = np.array(rows).reshape(-1, 4, 4)

    def eigenvalues(self):
        """In falling order of real, then of imaginary part."""
        e = np.linalg.eigvals(self.A)
        order = np.lexsort((-e.imag, -e.real), axis=-1)
        e = np.take_along_axis(e, order, axis=-1)
        return {"re": e.real.ravel().tolist(), "im": e.imag.ravel().tolist()}

    def repeat(self, repeats):
        begin = time.thread_time()
        for _ in range(repeats):
            np.linalg.eigvals(self.A)
        return {"seconds": time.thread_time() - begin}


class Peer:
    def __init__(self):
        self.ride = self.matrices = None

    def answer(self, request):
        do = request.pop("do")
        if do == "versions":
            return {"numpy": np.__version__, "scipy": scipy.__version__}
        if do == "load":
            self.ride = Ride(**request)
            return {}
        if do == "matrices":
            self.matrices = Matrices(**request)
            return self.matrices.eigenvalues()
        actions = {"tune": lambda: self.ride.tune, "ride": lambda: self.ride.repeat,
                   "evaluate": lambda: self.ride.evaluate,
                   "eigenvalues": lambda: self.matrices.repeat}
        return actions[do]()(**request)


def main():
    # the Fortran integrators print their complaints: those must not get among the answers
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    warnings.simplefilter("ignore")
    peer = Peer()
    for line in sys.stdin:
        try:
            reply = peer.answer(json.loads(line))
        except Exception as error:  # whatever it is, the bench goes on without this peer
            reply = {"error": f"{type(error).__name__}: {error}"}
        print(json.dumps(reply), file=answers, flush=True)


if __name__ == "__main__":
    main()
