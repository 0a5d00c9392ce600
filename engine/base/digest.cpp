#include "engine/base/digest.h"
