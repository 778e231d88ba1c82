#include "core/sheet/garment.hpp"
