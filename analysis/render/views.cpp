#include "analysis/render/render.hpp"
