#include "engine/base/random.h"
