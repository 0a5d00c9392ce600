#include "engine/base/parallel.h"
