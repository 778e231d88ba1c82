#include "core/nurbs/nurbs.hpp"
