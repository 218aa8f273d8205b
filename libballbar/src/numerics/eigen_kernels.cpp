#define BALLBAR_EIGEN_KERNEL template
#include "numerics/eigen_kernels.hpp"
