#pragma once

// How a template's source names the kinds of arithmetic that it is compiled for. The check that
// compiles the tracking path with floating point forbidden defines TUBESIGHT_FIXED_ONLY.
// Macros because explicit instantiations cannot be written by a template.

#ifdef TUBESIGHT_FIXED_ONLY
#define TUBESIGHT_INSTANTIATE_CLASS(name) template class name<::tubesight::core::FixedPoint>;
#define TUBESIGHT_FOR_EACH_SCALAR(macro) macro(::tubesight::core::FixedPoint)
#else
#define TUBESIGHT_INSTANTIATE_CLASS(name)             \
  template class name<::tubesight::core::FixedPoint>; \
  template class name<float>;                         \
  template class name<double>;
#define TUBESIGHT_FOR_EACH_SCALAR(macro) \
  macro(::tubesight::core::FixedPoint) macro(float) macro(double)
#endif
