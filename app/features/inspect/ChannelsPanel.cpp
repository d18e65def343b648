#include "app/features/inspect/ChannelsPanel.h"

#include "app/document/AnalysisController.h"
#include "app/document/Document.h"
#include "base/memoryShares.h"
#include "widgets/base/labelText.h"
#include "widgets/waterfall/LinkedPictures.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>

namespace faintline {

namespace {

    constexpr int longestReason = 200; ///< characters

    QToolButton *pageButton(Qt::ArrowType arrow, const QString &name)
    {
        auto *button = new QToolButton;
        button->setArrowType(arrow);
        button->setAutoRaise(true);
        button->setToolTip(name);
        button->setAccessibleName(name);
        return button;
    }

} // namespace

ChannelsPanel::ChannelsPanel(Document &document, AnalysisController &controller, QWidget *parent)
    : QWidget(parent), m_document(document), m_controller(controller), m_sentence(panelSentence()), m_page(new QLabel),
      m_previous(pageButton(Qt::LeftArrow, tr("Previous channels"))),
      m_next(pageButton(Qt::RightArrow, tr("Next channels"))),
      m_pictures(new LinkedPictures(document.viewport(), document.display(), document.direction())),
      m_channels(this, &ChannelsPanel::question, picturesOf, &ChannelsPanel::show)
{
    m_sentence->setAlignment(Qt::AlignCenter);
    m_sentence->setContentsMargins(16, 16, 16, 16);
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    buildPager();
    layout->addWidget(m_sentence, 1);
    layout->addWidget(m_pictures, 1);

    connect(m_pictures, &LinkedPictures::chosen, this, &ChannelsPanel::choose);
    connect(&m_channels, &JobRunner::busyChanged, this, &ChannelsPanel::begin);
    m_channels.watch(*this);
    connect(&document, &Document::opened, this, [this] {
        m_first = 0;
        follow();
    });
    for (const auto changed : {&Document::analysisChanged, &Document::settingsChanged, &Document::liveChanged})
        connect(&document, changed, this, &ChannelsPanel::follow);
    follow();
}

void ChannelsPanel::buildPager()
{
    auto *row = new QHBoxLayout;
    row->setContentsMargins(8, 2, 8, 2);
    row->addWidget(m_page, 1);
    row->addWidget(m_previous);
    row->addWidget(m_next);
    static_cast<QVBoxLayout *>(layout())->addLayout(row);
    m_page->setTextFormat(Qt::PlainText);
    connect(m_previous, &QToolButton::clicked, this, [this] { setFirstChannel(m_first - mostAtOnce); });
    connect(m_next, &QToolButton::clicked, this, [this] { setFirstChannel(m_first + mostAtOnce); });
}

int ChannelsPanel::channelCount() const
{
    return m_document.recording() ? m_document.recording()->info().channelCount : 0;
}

QString ChannelsPanel::obstacle() const
{
    if (m_document.isEmpty())
        return tr("Open a recording with several channels to compare them here.");
    if (!m_document.recording())
        return tr("Channels are shown for recordings of samples only.");
    if (channelCount() == 1)
        return m_document.recording()->info().isComplex ? tr("This recording has only one channel, of I and Q.")
                                                        : tr("This recording has only one channel.");
    if (!m_document.live().isEmpty())
        return tr("The channels are shown when the live run has ended.");
    if (!m_document.analysis())
        return tr("The channels are shown when the recording has been analysed.");
    return {};
}

std::vector<int> ChannelsPanel::analysed() const
{
    const SelectionSettings &selection = m_document.settings().selection;
    try {
        return channelsOf(selection, m_document.recording()->info());
    } catch (const Error &) { // the analysis reports it
        return {selection.channel};
    }
}

ChannelsPanel::Request ChannelsPanel::wanted() const
{
    const AnalysisSettings &used = m_document.analysis()->settings;
    Request request{m_document.recording(), {}, m_first, std::min(mostAtOnce, channelCount() - m_first)};
    request.settings.spectrogram = used.spectrogram;
    request.settings.noise = used.noise;
    request.settings.selection = used.selection;
    request.settings.selection.channel = 0;
    request.settings.selection.channels.clear();
    return request;
}

void ChannelsPanel::setFirstChannel(int channel)
{
    const int last = std::max(channelCount() - 1, 0);
    m_first = std::clamp(channel, 0, last) / mostAtOnce * mostAtOnce;
    follow();
}

void ChannelsPanel::follow()
{
    m_channels.ask();
    if (m_pictures->count() > 0)
        nameChannels();
}

ChannelsPanel::Asking::Question ChannelsPanel::question() const
{
    const QString why = obstacle();
    return why.isEmpty() ? Asking::Question(std::tuple(wanted())) : why;
}

void ChannelsPanel::nameChannels()
{
    const std::vector<int> chosen = analysed();
    for (int place = 0; place < m_pictures->count(); ++place) {
        const int channel = m_first + place;
        const bool isAnalysed = std::find(chosen.begin(), chosen.end(), channel) != chosen.end();
        m_pictures->at(place).setHeading((isAnalysed ? tr("Channel %1, analysed") : tr("Channel %1")).arg(channel));
    }
    const bool hasPages = channelCount() > mostAtOnce;
    m_page->setText(hasPages ? tr("Channels %1–%2 of %3. Click a channel to analyse it.")
                                   .arg(m_first)
                                   .arg(m_first + m_pictures->count() - 1)
                                   .arg(channelCount())
                             : tr("%1 channels. Click a channel to analyse it.").arg(channelCount()));
    for (QToolButton *button : {m_previous, m_next})
        button->setVisible(hasPages);
    m_previous->setEnabled(m_first > 0);
    m_next->setEnabled(m_first + mostAtOnce < channelCount());
}

std::vector<ChannelsPanel::Channel> ChannelsPanel::picturesOf(const Request &request, const RunContext &context,
                                                              const Asking::Partly &partly)
{
    std::vector<Channel> channels;
    for (int place = 0; place < request.count; ++place) {
        const auto share = [&](int done) { return double(done) / request.count; };
        Channel &channel = channels.emplace_back();
        try {
            channel.first = channelPicture(request.recording, request.settings, request.first + place,
                                           memoryShares::channels / std::size_t(request.count),
                                           context.part(share(place), share(place + 1)));
        } catch (const Error &error) { // of this channel; the others are shown
            channel.second = labelText(error.why(), longestReason);
        }
        partly(channels);
    }
    return channels;
}

void ChannelsPanel::begin()
{
    if (!m_channels.isRunning())
        return;
    showParts();
    m_pictures->setCount(wanted().count);
    for (int place = 0; place < m_pictures->count(); ++place) {
        m_pictures->at(place).setPicture(nullptr, {});
        m_pictures->at(place).setEmptySentence(tr("Computing channel %1 …").arg(m_first + place));
    }
    nameChannels();
}

/// The pictures, or in their place why there are none.
void ChannelsPanel::showParts()
{
    const QString &why = m_channels.whyNot();
    m_sentence->setText(why);
    m_sentence->setVisible(!why.isEmpty());
    for (QWidget *part : std::initializer_list<QWidget *>{m_pictures, m_page, m_previous, m_next})
        part->setVisible(why.isEmpty());
}

void ChannelsPanel::show()
{
    if (!m_channels.answer()) {
        showParts();
        return m_pictures->setCount(0);
    }
    for (int place = 0; const auto &[made, why] : *m_channels.answer()) {
        WaterfallView &view = m_pictures->at(place++);
        view.setEmptySentence(why);
        if (view.picture() != made.picture)
            view.setPicture(made.picture, made.frequency);
    }
}

void ChannelsPanel::choose(int place)
{
    const int channel = m_first + place;
    if (analysed() != std::vector{channel})
        m_controller.edit(QStringLiteral("selection.channel"), channel, tr("Analyse channel %1").arg(channel));
}

} // namespace faintline
