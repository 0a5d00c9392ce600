#include "engine/base/exact_math.h"
