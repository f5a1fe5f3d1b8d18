// Open MPI's header without the C++ bindings of old, which a file that includes it by itself would ask the linker for.
#pragma once

#define OMPI_SKIP_MPICXX 1
#include <mpi.h>
