//! The vector units that the swarm's loops are compiled for, chosen at run time.
//!
//! `pulp` gives safe vectors of numbers. What it has no name for common to all
//! units is added here: shifts of 64-bit words for the generators, a unit of half the
//! width for what a whole vector would leave half empty, and 128 bits on x86-64.

#[cfg(target_arch = "aarch64")]
use pulp::aarch64::Neon;
#[cfg(target_arch = "x86_64")]
use pulp::x86::{V2, V3, V4};
use pulp::{NullaryFnOnce, Scalar, Simd};

/// A vector unit.
pub trait Vectors: Simd {
    /// A narrower unit of the same machine, or the same where that gains nothing.
    type Half: Vectors;

    /// The narrower unit.
    fn half(self) -> Self::Half;

    /// Words shifted towards the higher bits; an `amount` known at compile time costs no register.
    fn shl(self, words: Self::u64s, amount: u64) -> Self::u64s;

    /// Words shifted towards the lower bits.
    fn shr(self, words: Self::u64s, amount: u64) -> Self::u64s;

    /// Words rotated towards the higher bits.
    #[inline(always)]
    fn rotl(self, words: Self::u64s, amount: u64) -> Self::u64s {
        self.or_u64s(self.shl(words, amount), self.shr(words, 64 - amount))
    }

    /// Whether any lane of `mask` is set.
    #[inline(always)]
    fn any(self, mask: Self::m64s) -> bool {
        self.first_true_m64s(mask) < Self::F64_LANES
    }
}

/// A loop over vectors.
pub trait Kernel {
    /// Runs it on a unit; to be inlined into code compiled for that unit.
    fn run<V: Vectors>(self, unit: V);
}

/// A unit that this machine has.
#[derive(Debug, Clone, Copy)]
pub enum Width {
    /// AVX-512: eight lanes.
    #[cfg(target_arch = "x86_64")]
    Avx512(V4),
    /// AVX2: four lanes.
    #[cfg(target_arch = "x86_64")]
    Avx2(V3),
    /// SSE 4.2: two lanes.
    #[cfg(target_arch = "x86_64")]
    Sse42(V2),
    /// NEON: two lanes.
    #[cfg(target_arch = "aarch64")]
    Neon(Neon),
    /// One number at a time.
    Scalar,
}

impl Width {
    /// Every unit of this machine, the widest first.
    pub fn all() -> impl Iterator<Item = Self> {
        #[cfg(target_arch = "x86_64")]
        let vectors = [V4::try_new().map(Self::Avx512), V3::try_new().map(Self::Avx2), V2::try_new().map(Self::Sse42)];
        #[cfg(target_arch = "aarch64")]
        let vectors = [Neon::try_new().map(Self::Neon)];
        #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
        let vectors = [None];
        vectors.into_iter().flatten().chain([Self::Scalar])
    }

    /// The widest.
    pub fn widest() -> Self {
        Self::all().next().unwrap_or(Self::Scalar)
    }

    /// Its usual name.
    pub fn name(self) -> &'static str {
        match self {
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(_) => "AVX-512",
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(_) => "AVX2",
            #[cfg(target_arch = "x86_64")]
            Self::Sse42(_) => "SSE 4.2",
            #[cfg(target_arch = "aarch64")]
            Self::Neon(_) => "NEON",
            Self::Scalar => "scalar",
        }
    }

    /// Runs a kernel.
    #[inline(always)]
    pub(crate) fn run(self, kernel: impl Kernel) {
        match self {
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(unit) => Simd::vectorize(unit, On { unit, kernel }),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(unit) => Simd::vectorize(unit, On { unit, kernel }),
            #[cfg(target_arch = "x86_64")]
            Self::Sse42(unit) => Simd::vectorize(unit, On { unit, kernel }),
            #[cfg(target_arch = "aarch64")]
            Self::Neon(unit) => Simd::vectorize(unit, On { unit, kernel }),
            Self::Scalar => Simd::vectorize(Scalar, On { unit: Scalar, kernel }),
        }
    }
}

/// A kernel on a unit, as `pulp` wants it.
struct On<V, K> {
    unit: V,
    kernel: K,
}

impl<V: Vectors, K: Kernel> NullaryFnOnce for On<V, K> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        self.kernel.run(self.unit);
    }
}

#[cfg(target_arch = "x86_64")]
impl Vectors for V4 {
    type Half = V3;

    #[inline(always)]
    fn half(self) -> V3 {
        *self
    }

    #[inline(always)]
    fn shl(self, words: Self::u64s, amount: u64) -> Self::u64s {
        self.shl_dyn_u64x8(words, self.splat_u64x8(amount))
    }

    #[inline(always)]
    fn shr(self, words: Self::u64s, amount: u64) -> Self::u64s {
        self.shr_dyn_u64x8(words, self.splat_u64x8(amount))
    }
}

#[cfg(target_arch = "x86_64")]
impl Vectors for V3 {
    type Half = V3;

    #[inline(always)]
    fn half(self) -> V3 {
        self
    }

    #[inline(always)]
    fn shl(self, words: Self::u64s, amount: u64) -> Self::u64s {
        self.shl_dyn_u64x4(words, self.splat_u64x4(amount))
    }

    #[inline(always)]
    fn shr(self, words: Self::u64s, amount: u64) -> Self::u64s {
        self.shr_dyn_u64x4(words, self.splat_u64x4(amount))
    }
}

#[cfg(target_arch = "x86_64")]
impl Vectors for V2 {
    type Half = V2;

    #[inline(always)]
    fn half(self) -> V2 {
        self
    }

    #[inline(always)]
    fn shl(self, words: Self::u64s, amount: u64) -> Self::u64s {
        self.shl_u64x2(words, self.splat_u64x2(amount))
    }

    #[inline(always)]
    fn shr(self, words: Self::u64s, amount: u64) -> Self::u64s {
        self.shr_u64x2(words, self.splat_u64x2(amount))
    }
}

#[cfg(target_arch = "aarch64")]
impl Vectors for Neon {
    type Half = Neon;

    #[inline(always)]
    fn half(self) -> Neon {
        self
    }

    #[inline(always)]
    fn shl(self, words: Self::u64s, amount: u64) -> Self::u64s {
        self.shl_dyn_u64x2(words, self.splat_i64x2(amount as i64))
    }

    #[inline(always)]
    fn shr(self, words: Self::u64s, amount: u64) -> Self::u64s {
        // Its shifts by a negative amount go the other way.
        self.shl_dyn_u64x2(words, self.splat_i64x2(-(amount as i64)))
    }
}

impl Vectors for Scalar {
    type Half = Scalar;

    #[inline(always)]
    fn half(self) -> Scalar {
        self
    }

    #[inline(always)]
    fn shl(self, words: u64, amount: u64) -> u64 {
        words << amount
    }

    #[inline(always)]
    fn shr(self, words: u64, amount: u64) -> u64 {
        words >> amount
    }
}
