#pragma once
// The generated messages share the package's namespace, and the core has a RecognizedObject of its own. Here
// the message is RecognizedObjectMsg; include messages only through this file.
#define RecognizedObject RecognizedObjectMsg
#include <monocular_eye_hand/Recognize.h>
#include <monocular_eye_hand/RecognizedObject.h>
#include <monocular_eye_hand/RecognizedObjectArray.h>
#undef RecognizedObject
