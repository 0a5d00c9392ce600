#include "engine/render/frame_renderer.h"
