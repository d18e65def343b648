#pragma once

#include "app/base/Inquiry.h"
#include "inspect/closeup.h"

#include <QWidget>

#include <vector>

class QLabel;
class QToolButton;

namespace faintline {

class AnalysisController;
class Document;
class LinkedPictures;

/// The input of each channel of a recording beside each other, over its own noise, with linked zoom and cursor and one
/// range of colours. A click on a channel makes it the analysed one. At most eight channels are shown at once, with
/// buttons for the next and previous ones. Computed while visible.
class ChannelsPanel : public QWidget
{
    Q_OBJECT

public:
    static constexpr int mostAtOnce = 8;

    ChannelsPanel(Document &document, AnalysisController &controller, QWidget *parent = nullptr);

    LinkedPictures &pictures() const { return *m_pictures; }
    int firstChannel() const { return m_first; }
    /// Shows the page that begins with this channel or contains it.
    void setFirstChannel(int channel);

    QSize sizeHint() const override { return {720, 300}; }

private:
    /// What the pictures are made from.
    struct Request {
        RecordingPointer recording;
        AnalysisSettings settings; ///< without what differs from channel to channel or comes after the frames
        int first = 0;
        int count = 0;
        bool operator==(const Request &) const = default;
    };
    /// A channel's picture, or why there is none.
    using Channel = std::pair<ChannelPicture, QString>;
    using Asking = Inquiry<std::vector<Channel>, Request>;

    static std::vector<Channel> picturesOf(const Request &request, const RunContext &context,
                                           const Asking::Partly &partly);
    QString obstacle() const;
    Asking::Question question() const;
    int channelCount() const;
    std::vector<int> analysed() const;
    Request wanted() const;
    void buildPager();
    void follow();
    void nameChannels();
    void begin();
    void show();
    void showParts();
    void choose(int place);

    Document &m_document;
    AnalysisController &m_controller;
    QLabel *m_sentence; ///< in place of the pictures
    QLabel *m_page;
    QToolButton *m_previous;
    QToolButton *m_next;
    LinkedPictures *m_pictures;
    int m_first = 0;
    Asking m_channels;
};

} // namespace faintline
