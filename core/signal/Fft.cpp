#include "signal/Fft.h"

#include "base/Error.h"

#include <fftw3.h>

#include <algorithm>
#include <mutex>
#include <string>

namespace faintline {

namespace {

    // FFTW's planner is its only part that is not thread-safe.
    std::mutex plannerMutex;

    fftwf_complex *fftw(std::span<std::complex<float>> bins)
    {
        return reinterpret_cast<fftwf_complex *>(bins.data());
    }

} // namespace

Fft::Buffer::Buffer(std::size_t inputFloats, std::size_t outputBins)
    : m_input(fftwf_alloc_real(inputFloats), inputFloats),
      m_output(reinterpret_cast<std::complex<float> *>(fftwf_alloc_complex(outputBins)), outputBins)
{
    std::fill(m_input.begin(), m_input.end(), 0.0f);
}

Fft::Buffer::~Buffer()
{
    fftwf_free(m_input.data());
    fftwf_free(m_output.data());
}

Fft::Fft(int length, Input input) : m_length(length), m_input(input)
{
    if (length < 1)
        throw Error("transform length " + std::to_string(length), "must be at least 1");
    const auto scratch = buffer();
    constexpr unsigned flags = FFTW_ESTIMATE | FFTW_PRESERVE_INPUT;
    const std::scoped_lock lock(plannerMutex);
    if (input == Input::Real)
        m_plan = fftwf_plan_dft_r2c_1d(length, scratch->m_input.data(), fftw(scratch->m_output), flags);
    else
        m_plan = fftwf_plan_dft_1d(length, reinterpret_cast<fftwf_complex *>(scratch->m_input.data()),
                                   fftw(scratch->m_output), FFTW_FORWARD, flags);
}

Fft::~Fft()
{
    const std::scoped_lock lock(plannerMutex);
    fftwf_destroy_plan(static_cast<fftwf_plan>(m_plan));
}

std::unique_ptr<Fft::Buffer> Fft::buffer() const
{
    const auto n = std::size_t(m_length);
    return std::unique_ptr<Buffer>(new Buffer(m_input == Input::Real ? n : 2 * n, std::size_t(binCount())));
}

void Fft::run(Buffer &buffer) const
{
    const auto plan = static_cast<fftwf_plan>(m_plan);
    if (m_input == Input::Real)
        fftwf_execute_dft_r2c(plan, buffer.m_input.data(), fftw(buffer.m_output));
    else
        fftwf_execute_dft(plan, reinterpret_cast<fftwf_complex *>(buffer.m_input.data()), fftw(buffer.m_output));
}

int Fft::fastLength(int wanted)
{
    for (int length = std::max(1, wanted);; ++length) {
        int rest = length;
        for (int prime : {2, 3, 5, 7})
            while (rest % prime == 0)
                rest /= prime;
        if (rest == 1)
            return length;
    }
}

} // namespace faintline
