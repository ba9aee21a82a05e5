#pragma once

// The message and the core's grid are both called pilothouse::FloorGrid. Here the message's short
// name is changed, so that one file may use both.
#define FloorGrid FloorGridMessage
#include "pilothouse/FloorGrid.h"
#undef FloorGrid
