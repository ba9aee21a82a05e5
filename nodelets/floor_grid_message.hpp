#pragma once

// The message pilothouse/FloorGrid and the core's FloorGrid would both be pilothouse::FloorGrid in
// C++. Whoever needs both includes the message from here, as pilothouse::FloorGridMessage.
#define FloorGrid FloorGridMessage
#include <pilothouse/FloorGrid.h>
#undef FloorGrid
