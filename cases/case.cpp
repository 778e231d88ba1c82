#include "cases/run.hpp"
