#include "engine/scene/load.h"
