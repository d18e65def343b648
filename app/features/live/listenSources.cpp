#include "app/features/live/listenSources.h"

#include "app/base/filePath.h"
#include "app/base/tr.h"
#include "app/document/rawFields.h"
#include "base/Error.h"
#include "live/sources/IqSource.h"
#include "live/sources/PipeSource.h"
#include "live/sources/RtlTcpSource.h"
#include "live/sources/SoundSource.h"
#include "live/sources/UdpSource.h"
#include "live/sources/soundDevices.h"
#include "signal/formats/SampleType.h"
#include "widgets/forms/FieldForm.h"

#include <QCheckBox>
#include <QComboBox>
#include <QCoreApplication>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSpinBox>
#include <QToolButton>
#include <QUrl>

#include <algorithm>
#include <optional>

namespace faintline {

namespace {

    QDoubleSpinBox *hertzBox(double value, double lowest, double highest)
    {
        auto *box = new QDoubleSpinBox;
        box->setRange(lowest, highest);
        box->setDecimals(3);
        box->setSuffix(tr(" Hz"));
        box->setGroupSeparatorShown(false);
        box->setValue(value);
        return box;
    }

    LiveRun::OpenSource withIq(LiveRun::OpenSource open, bool iq)
    {
        if (!iq)
            return open;
        return [open = std::move(open)](const std::stop_token &stop) -> std::unique_ptr<SampleSource> {
            return std::make_unique<IqSource>(open(stop));
        };
    }

    /// Form for the format of samples without a header.
    class RawForm final : public FieldForm<OpenOptions>
    {
    public:
        RawForm() : FieldForm(tr("Samples"), ofStreams(), {false, "ri16_le", 48000.0}) {}

        /// Throws Error if a value was refused.
        StreamFormat format() const
        {
            if (isRefused())
                throw Error(tr("Samples").toStdString(), tr("correct the marked value").toStdString());
            return {parseSampleType(value().rawType, "type"), value().rawRateHz, value().rawChannels, 0.0, {}};
        }
        double bytesPerSecond() const
        {
            const Index bytes = parseSampleType(value().rawType, "type").sampleBytes();
            return double(bytes * value().rawChannels) * value().rawRateHz;
        }

    private:
        static std::vector<Field<OpenOptions>> ofStreams()
        {
            std::vector<Field<OpenOptions>> fields = rawFields();
            std::erase_if(fields,
                          [](const auto &field) { return field.name == "rawHeaderBytes" || field.name == "iq"; });
            return fields;
        }
    };

    class PipeForm final : public ListenSourceForm
    {
    public:
        PipeForm()
        {
            auto *browse = new QToolButton;
            browse->setText(tr("Browse…"));
            QObject::connect(browse, &QToolButton::clicked, this, [this] {
                const QString path = pathOf(QFileDialog::getOpenFileUrl(this, tr("Pipe or file")));
                if (!path.isEmpty())
                    m_path->setText(path);
            });
            auto *row = new QHBoxLayout;
            row->addWidget(m_path, 1);
            row->addWidget(browse);
            m_path->setPlaceholderText(tr("FIFO made with mkfifo, or a file"));
            m_path->setObjectName(QStringLiteral("pipePath"));
            m_header->setChecked(true);
            m_raw->setEnabled(false);
            QObject::connect(m_header, &QCheckBox::toggled, m_raw, &QWidget::setDisabled);
            auto *form = new QFormLayout(this);
            auto *label = new QLabel(tr("&Path"));
            label->setBuddy(m_path);
            form->addRow(label, row);
            form->addRow(QString(), m_header);
            form->addRow(m_raw);
            form->addRow(QString(), m_iq);
        }

        LiveRun::OpenSource source() const override
        {
            if (m_path->text().trimmed().isEmpty())
                throw Error(tr("Path").toStdString(), tr("is empty; give a FIFO or a file").toStdString());
            std::optional<StreamFormat> raw;
            if (!m_header->isChecked())
                raw = m_raw->format();
            return withIq(
                [path = pathBytes(m_path->text().trimmed()), raw](const std::stop_token &stop)
                    -> std::unique_ptr<SampleSource> { return std::make_unique<PipeSource>(path, raw, stop); },
                m_iq->isChecked());
        }

        std::optional<double> bytesPerSecond() const override
        {
            return m_header->isChecked() ? std::nullopt : std::optional(m_raw->bytesPerSecond());
        }

    private:
        QLineEdit *m_path = new QLineEdit;
        QCheckBox *m_header = new QCheckBox(tr("Begins with a WAV header"));
        RawForm *m_raw = new RawForm;
        QCheckBox *m_iq = new QCheckBox(tr("Take channels in pairs as I and Q"));
    };

    class UdpForm final : public ListenSourceForm
    {
    public:
        UdpForm()
        {
            m_address->setPlaceholderText(tr("PORT or ADDRESS:PORT of this machine"));
            for (const char *number : {"", "u16le", "u16be", "u32le", "u32be", "u64le", "u64be"})
                m_sequence->addItem(number[0] ? QString::fromLatin1(number) : tr("none"), QString::fromLatin1(number));
            m_sequence->setToolTip(tr("Number at the beginning of each datagram, by which lost ones are counted"));
            auto *form = new QFormLayout(this);
            form->addRow(tr("&Port"), m_address);
            form->addRow(tr("Sequence &number"), m_sequence);
            form->addRow(m_raw);
            form->addRow(QString(), m_iq);
        }

        LiveRun::OpenSource source() const override
        {
            if (m_address->text().trimmed().isEmpty())
                throw Error(tr("Port").toStdString(), tr("is empty; give PORT or ADDRESS:PORT").toStdString());
            const auto sequence = parseSequenceNumbers(m_sequence->currentData().toString().toStdString());
            return withIq(
                [address = m_address->text().trimmed().toStdString(), raw = m_raw->format(),
                 sequence](const std::stop_token &) -> std::unique_ptr<SampleSource> {
                    return std::make_unique<UdpSource>(address, raw, sequence);
                },
                m_iq->isChecked());
        }

        std::optional<double> bytesPerSecond() const override { return m_raw->bytesPerSecond(); }

    private:
        QLineEdit *m_address = new QLineEdit;
        QComboBox *m_sequence = new QComboBox;
        RawForm *m_raw = new RawForm;
        QCheckBox *m_iq = new QCheckBox(tr("Take channels in pairs as I and Q"));
    };

    class RtlTcpForm final : public ListenSourceForm
    {
    public:
        RtlTcpForm()
        {
            m_address->setText(QStringLiteral("localhost:1234"));
            m_gain->setRange(-1.0, 100.0);
            m_gain->setSpecialValueText(tr("automatic"));
            m_gain->setSuffix(tr(" dB"));
            m_gain->setValue(-1.0);
            m_ppm->setRange(-1000, 1000);
            m_ppm->setSuffix(tr(" ppm"));
            auto *form = new QFormLayout(this);
            form->addRow(tr("&Server"), m_address);
            form->addRow(tr("&Frequency"), m_frequency);
            form->addRow(tr("Sample &rate"), m_rate);
            form->addRow(tr("&Gain"), m_gain);
            form->addRow(tr("C&orrection"), m_ppm);
        }

        LiveRun::OpenSource source() const override
        {
            ReceiverSettings receiver{m_frequency->value(), m_rate->value(), {}, m_ppm->value()};
            if (m_gain->value() > m_gain->minimum())
                receiver.gainDb = m_gain->value();
            return [address = m_address->text().trimmed().toStdString(),
                    receiver](const std::stop_token &) -> std::unique_ptr<SampleSource> {
                return std::make_unique<RtlTcpSource>(address, receiver);
            };
        }

        std::optional<double> bytesPerSecond() const override
        {
            constexpr double sampleBytes = 2.0;
            return sampleBytes * m_rate->value();
        }

    private:
        QLineEdit *m_address = new QLineEdit;
        QDoubleSpinBox *m_frequency = hertzBox(14.074e6, 1.0, 4294967295.0);
        QDoubleSpinBox *m_rate = hertzBox(240000.0, 1.0, 1e8);
        QDoubleSpinBox *m_gain = new QDoubleSpinBox;
        QSpinBox *m_ppm = new QSpinBox;
    };

    class SoundForm final : public ListenSourceForm
    {
    public:
        SoundForm()
        {
            m_device->addItem(tr("Default"), QStringLiteral("default"));
            for (const SoundDevice &device : soundDevices())
                if (device.inputChannels > 0)
                    m_device->addItem(QString::fromStdString(device.name), QString::fromStdString(device.name));
            m_device->setObjectName(QStringLiteral("soundDevice"));
            m_rate->setSpecialValueText(tr("the device's own"));
            m_channels->setRange(0, 64);
            m_channels->setSpecialValueText(tr("the device's, at most 2"));
            auto *form = new QFormLayout(this);
            form->addRow(tr("&Device"), m_device);
            form->addRow(tr("Sample &rate"), m_rate);
            form->addRow(tr("&Channels"), m_channels);
            form->addRow(QString(), m_iq);
        }

        LiveRun::OpenSource source() const override
        {
            SoundSettings sound;
            sound.device = m_device->currentData().toString().toStdString();
            sound.sampleRateHz = m_rate->value();
            sound.channelCount = m_channels->value();
            return withIq(
                [sound](const std::stop_token &) -> std::unique_ptr<SampleSource> {
                    return std::make_unique<SoundSource>(sound);
                },
                m_iq->isChecked());
        }

        std::optional<double> bytesPerSecond() const override
        {
            if (m_rate->value() == 0.0 || m_channels->value() == 0)
                return {};
            return m_rate->value() * m_channels->value() * double(SoundSettings().type.sampleBytes());
        }

    private:
        QComboBox *m_device = new QComboBox;
        QDoubleSpinBox *m_rate = hertzBox(0.0, 0.0, 1e6);
        QSpinBox *m_channels = new QSpinBox;
        QCheckBox *m_iq = new QCheckBox(tr("Take channels in pairs as I and Q"));
    };

} // namespace

const std::vector<ListenSourceKind> &listenSourceKinds()
{
    static const std::vector<ListenSourceKind> kinds{
        {tr("Sound device"), [] { return new SoundForm; }},
        {tr("Pipe or file"), [] { return new PipeForm; }},
        {tr("UDP"), [] { return new UdpForm; }},
        {tr("Receiver (rtl_tcp)"), [] { return new RtlTcpForm; }},
    };
    return kinds;
}

} // namespace faintline
