// SPDX-License-Identifier: Apache-2.0
#include "samples.h"

// Numbers of table 1 of Meijaard et al. (2007).
#define MEIJAARD(indent)                                                                           \
  indent "w: 1.02\n" indent "c: 0.08\n" indent "lam: 0.3141592653589793\n" indent                  \
         "g: 9.81\n" indent "rR: 0.3\n" indent "mR: 2.0\n" indent "IRxx: 0.0603\n" indent          \
         "IRyy: 0.12\n" indent "xB: 0.3\n" indent "zB: -0.9\n" indent "mB: 85.0\n" indent          \
         "IBxx: 9.2\n" indent "IByy: 11.0\n" indent "IBzz: 2.8\n" indent "IBxz: 2.4\n" indent      \
         "xH: 0.9\n" indent "zH: -0.7\n" indent "mH: 4.0\n" indent "IHxx: 0.05892\n" indent        \
         "IHyy: 0.06\n" indent "IHzz: 0.00708\n" indent "IHxz: -0.00756\n" indent                  \
         "rF: 0.35\n" indent "mF: 3.0\n" indent "IFxx: 0.1405\n" indent "IFyy: 0.28\n"

const char SAMPLE_VALUES[] = "parameterization: Meijaard2007\n" // line 1
                             "parameters: bench\n"
                             "rider: true\n"
                             "description: a bicycle\n"
                             "values:\n" // line 5; w is on line 6, IFyy on line 31
    MEIJAARD("  ");

const char SAMPLE_FLAT[] = MEIJAARD(""); // w is on line 1

const char SAMPLE_TEXT[] =
    "# measured\n"
    "w = 1.02+/-0.001\nc = 0.08+/-0.0\nlam=0.3141592653589793\ng = 9.81 +/- 0.01\n"
    "rR = 0.3\nmR = 2.0\nIRxx = (6.03+/-0.01)e-02\nIRyy = 0.12\nxB = 0.3\nzB = -0.9\n"
    "mB = 85.0\nIBxx = 9.2\nIByy = 11.0\nIBzz = 2.8\nIBxz = 2.4\nxH = 0.9\nzH = -0.7\n"
    "mH = 4.0\nIHxx = 0.05892\nIHyy = 0.06\nIHzz = 0.00708\nIHxz = -0.00756 # inline\n"
    "\nrF = 0.35\nmF = 3.0\nIFxx = 0.1405\nIFyy = 0.28\n";

#define PARTS                                                                                      \
  "parts:\n"                                                                                       \
  "  - name: rear wheel\n"                                                                         \
  "    assembly: rear_wheel\n"                                                                     \
  "    mass: 2\n"                                                                                  \
  "    inertia: {spin: 0.2}\n"                                                                     \
  "  - name: frame\n"                                                                              \
  "    assembly: rear\n"                                                                           \
  "    mass: 12\n"                                                                                 \
  "    position: [0.45, 0.01, 0.55]\n"                                                             \
  "    inertia:\n"                                                                                 \
  "      full: [0.5, 0.6, 0.4, 0.01, -0.1, 0.02]\n"                                                \
  "  - name: rider\n"                                                                              \
  "    assembly: rear\n"                                                                           \
  "    mass: 70\n"                                                                                 \
  "    position: [0.36, 0, 1.08]\n"                                                                \
  "    inertia: none\n"                                                                            \
  "    rider: true\n"                                                                              \
  "  - name: bar\n"                                                                                \
  "    assembly: front\n"                                                                          \
  "    mass: 3\n"                                                                                  \
  "    position: [0.86, 0, 0.85]\n"                                                                \
  "    inertia: {steering: 0.1}\n"                                                                 \
  "  - name: front wheel\n"                                                                        \
  "    assembly: front_wheel\n"                                                                    \
  "    mass: 2\n"                                                                                  \
  "    position: [1.11, 0, 0.34]\n"                                                                \
  "    inertia: {full: [0.1, 0.2, 0.1, 0, 0, 0]}\n"

const char SAMPLE_COMPONENTS[] = "parameterization: components\n" // line 1
                                 "name: roadster\n"
                                 "g: 9.81\n"
                                 "steer_damping: 0.5\n"
                                 "geometry:\n" // line 5
                                 "  wheelbase: 1.11\n"
                                 "  trail: 0.07\n"
                                 "  head_angle: 1.1868238913561442\n"
                                 "  rear_radius: 0.34\n"
                                 "  front_radius: 0.34\n" PARTS; // line 11

// (w + c) sin h - R cos h, R cos h - c sin h, w cos h for the angles above
const char SAMPLE_LENGTHS[] = "parameterization: components\n"
                              "g: 9.81\n"
                              "geometry:\n" // line 3
                              "  L_r: 0.9667107066273992\n"
                              "  L_f: 0.062463371941734944\n"
                              "  L_s: 0.4158133186916623\n"
                              "  R_r: 0.34\n"
                              "  R_f: 0.34\n" PARTS;
