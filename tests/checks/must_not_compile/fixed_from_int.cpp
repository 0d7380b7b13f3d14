// expect: conversion from .int. to non-scalar type|could not convert|cannot convert
// An integer does not become a fixed-point number by itself.
#include "core/base/fixed.h"

using Mm = tubesight::core::Fixed<16, 16>;

#ifdef TUBESIGHT_MUST_NOT_COMPILE
const Mm kHeightMm = 90;
#else
const Mm kHeightMm = Mm(90);
#endif
