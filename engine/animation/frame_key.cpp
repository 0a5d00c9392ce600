#include "engine/animation/frame_key.h"
