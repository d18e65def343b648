#include "widgets/waterfall/PictureDisplay.h"

#include <utility>

namespace faintline {

void PictureDisplay::setColourMap(const QString &name)
{
    const ColourMap *map = &ColourMap::named(name);
    if (std::exchange(m_colourMap, map) != map)
        emit coloursChanged();
}

void PictureDisplay::setLayer(Layer layer, bool isOn)
{
    if (shows(layer) == isOn)
        return;
    m_layers.setFlag(layer, isOn);
    emit layersChanged();
}

void PictureDisplay::setMeasuring(bool isOn)
{
    if (std::exchange(m_isMeasuring, isOn) != isOn)
        emit measuringChanged();
}

void PictureDisplay::setHarmonics(bool isOn)
{
    if (std::exchange(m_hasHarmonics, isOn) != isOn)
        emit linesChanged();
}

void PictureDisplay::setSidebandSpacing(double hz)
{
    if (std::exchange(m_sidebandHz, hz) != hz)
        emit linesChanged();
}

void PictureDisplay::setPolar(bool isOn)
{
    if (std::exchange(m_isPolar, isOn) != isOn)
        emit projectionChanged();
}

} // namespace faintline
