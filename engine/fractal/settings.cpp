#include "engine/fractal/settings.h"
