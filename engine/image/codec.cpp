#include "engine/image/codec.h"
