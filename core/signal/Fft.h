#pragma once

#include <complex>
#include <memory>
#include <span>

namespace faintline {

/// A forward Fourier transform of fixed length, X(k) = Σ x(n) e^{-2πikn/N}, in single precision; not scaled.
///
/// Wraps an FFTW plan made with FFTW_ESTIMATE, because measured plans, and thus the last bits, vary from run to run.
/// `run` may be called from several threads at once, each with its own `buffer()`.
class Fft
{
public:
    enum class Input { Real, Complex };

    /// Throws Error for a length below 1.
    Fft(int length, Input input);
    ~Fft();
    Fft(const Fft &) = delete;
    Fft &operator=(const Fft &) = delete;

    /// Aligned working storage for one transform at a time.
    class Buffer
    {
    public:
        /// `length` floats (Real) or 2·`length` floats (Complex, interleaved).
        std::span<float> input() { return m_input; }
        /// length/2+1 bins (Real) or `length` bins (Complex), from 0 Hz upward, then the negative frequencies.
        std::span<const std::complex<float>> output() const { return m_output; }
        ~Buffer();
        Buffer(const Buffer &) = delete;
        Buffer &operator=(const Buffer &) = delete;

    private:
        friend class Fft;
        Buffer(std::size_t inputFloats, std::size_t outputBins);
        std::span<float> m_input;
        std::span<std::complex<float>> m_output;
    };

    /// Its input is 0.
    std::unique_ptr<Buffer> buffer() const;

    /// Transforms the buffer's input into its output; the input remains.
    void run(Buffer &buffer) const;

    int length() const { return m_length; }
    int binCount() const { return m_input == Input::Real ? m_length / 2 + 1 : m_length; }

    /// The smallest length ≥ wanted with prime factors 2, 3, 5 and 7 only, which FFTW transforms fast.
    static int fastLength(int wanted);

private:
    int m_length;
    Input m_input;
    void *m_plan = nullptr;
};

} // namespace faintline
