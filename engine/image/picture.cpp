#include "engine/image/picture.h"
