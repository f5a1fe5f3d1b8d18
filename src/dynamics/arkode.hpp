// ARKODE of SUNDIALS as the reference uses it: an explicit Runge-Kutta method of order 5, and errors that end the program's work.
#pragma once

#include <arkode/arkode_erkstep.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>

#include <algorithm>
#include <freestand/error.hpp>
#include <memory>
#include <string>

namespace freestand::dynamics {

struct Delete {
  void operator()(_SUNContext* context) const { SUNContext_Free(&context); }
  void operator()(_generic_N_Vector* vector) const { N_VDestroy(vector); }
  void operator()(void* memory) const { ERKStepFree(&memory); }
};

inline void check(int flag, const char* what) {
  if (flag < 0)
    throw Error(std::string("the reference integrator failed (SUNDIALS ") + what + " returned " + std::to_string(flag) +
                    "): loosen the tolerance",
                Exit::data);
}

using Arkode = std::unique_ptr<void, Delete>;

inline Arkode make_arkode(double wanted, ARKRhsFn derivative, N_Vector y, SUNContext context, void* self) {
  Arkode arkode(ERKStepCreate(derivative, 0, y, context));
  if (!arkode)
    throw Error("the reference integrator cannot start (SUNDIALS has no memory): free some memory", Exit::data);
  void* ark = arkode.get();
  const auto quiet = [](int, const char*, const char*, char*, void*) {};  // failures are outcomes
  check(ERKStepSetErrHandlerFn(ark, quiet, nullptr), "ERKStepSetErrHandlerFn");
  check(ERKStepSetTableNum(ark, ARKODE_DORMAND_PRINCE_7_4_5), "ERKStepSetTableNum");
  const double tolerance = std::max(wanted, 1e-11);  // below, round-off fails its error test
  check(ERKStepSStolerances(ark, tolerance, 0.1 * tolerance), "ERKStepSStolerances");
  check(ERKStepSetUserData(ark, self), "ERKStepSetUserData");
  check(ERKStepSetMaxNumSteps(ark, 100000), "ERKStepSetMaxNumSteps");
  return arkode;
}

}  // namespace freestand::dynamics
