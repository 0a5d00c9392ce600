#include "engine/fractal/registry.h"
