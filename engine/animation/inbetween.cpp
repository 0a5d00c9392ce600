#include "engine/animation/inbetween.h"
