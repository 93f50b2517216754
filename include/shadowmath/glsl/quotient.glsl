// SPDX-License-Identifier: MIT
//
// a / b as IEEE 754 rounds it, on drivers that divide to 2.5 ulp (all that GLSL asks for): the driver's quotient, and
// the exact remainder divided once more. Where the driver's quotient is right already it stays. With it a fit that is
// made of products, sums and quotients has the same bits as its C++ on every processor.
//
// For |a|, |b| and |a / b| from 1e-30 to 1e30; outside, and for NaN, the driver's own quotient.
#ifndef SM_QUOTIENT_GLSL
#define SM_QUOTIENT_GLSL

float sm_quotient(float a, float b) {
    precise float q = a / b;
    vec3 magnitude = abs(vec3(a, b, q));
    if (!(all(greaterThan(magnitude, vec3(1e-30))) && all(lessThan(magnitude, vec3(1e30))))) return q;
    // q b = product + rest exactly: factors cut in halves of twelve bits (Dekker 1971).
    precise float q_cut = 4097.0 * q;
    precise float b_cut = 4097.0 * b;
    precise float q_high = q_cut - (q_cut - q);
    precise float b_high = b_cut - (b_cut - b);
    precise float q_low = q - q_high;
    precise float b_low = b - b_high;
    precise float product = q * b;
    precise float rest = ((q_high * b_high - product) + q_high * b_low + q_low * b_high) + q_low * b_low;
    precise float remainder = (a - product) - rest;
    precise float corrected = q + remainder / b;
    return corrected;
}

// The driver's own a / b, and 0 where b is 0.
float sm_quotient_or_zero(float a, float b) {
    precise float q = b != 0.0 ? a / b : 0.0;
    return q;
}

#endif
