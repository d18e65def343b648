#include "app/panels/OpenOptionsDialog.h"

#include "app/base/filePath.h"
#include "app/panels/sampleTypeBox.h"
#include "base/Error.h"
#include "signal/formats/RawRecording.h"
#include "signal/formats/SampleType.h"
#include "widgets/base/labelText.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>

namespace faintline {

namespace {

    /// Type and rate as a receiver's program wrote them into the name, else the type of the extension.
    OpenOptions suggested(const QString &path)
    {
        OpenOptions options = withNamedFormat(pathBytes(path), {});
        if (options.rawType.empty())
            options.rawType = rawTypeOfExtension(pathBytes(path)).value_or("");
        if (options.rawType.empty())
            options.rawType = "ci16_le";
        if (!(options.rawRateHz > 0.0))
            options.rawRateHz = 48000.0;
        return options;
    }

} // namespace

OpenOptionsDialog::OpenOptionsDialog(const QString &path, QWidget *parent)
    : QDialog(parent), m_fileBytes(fileSize(path)), m_type(sampleTypeBox()), m_rate(new QDoubleSpinBox),
      m_channels(new QSpinBox), m_header(new QSpinBox), m_iq(new QCheckBox(tr("Take channels in pairs as I and Q"))),
      m_length(plainLabel())
{
    setWindowTitle(tr("Raw samples"));
    const OpenOptions named = suggested(path);
    m_type->setCurrentText(QString::fromStdString(named.rawType));
    m_rate->setRange(1e-6, 1e12);
    m_rate->setDecimals(3);
    m_rate->setValue(named.rawRateHz);
    m_rate->setSuffix(tr(" Hz"));
    m_rate->setGroupSeparatorShown(false);
    m_channels->setRange(1, 1024);
    m_header->setRange(0, 1 << 30);
    m_header->setSuffix(tr(" bytes"));

    auto *buttons = new QDialogButtonBox(QDialogButtonBox::Open | QDialogButtonBox::Cancel);
    connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);

    auto *form = new QFormLayout(this);
    auto *what = new QLabel(
        tr("<b>%1</b> holds samples without a header. Specify their format.").arg(fileLabel(path).toHtmlEscaped()));
    form->addRow(what);
    form->addRow(tr("&Type"), m_type);
    form->addRow(tr("Sample &rate"), m_rate);
    form->addRow(tr("&Channels"), m_channels);
    form->addRow(tr("&Skip at the start"), m_header);
    form->addRow(QString(), m_iq);
    form->addRow(tr("Length"), m_length);
    form->addRow(buttons);

    connect(m_type, &QComboBox::currentTextChanged, this, &OpenOptionsDialog::showLength);
    connect(m_rate, &QDoubleSpinBox::valueChanged, this, &OpenOptionsDialog::showLength);
    connect(m_channels, &QSpinBox::valueChanged, this, &OpenOptionsDialog::showLength);
    connect(m_header, &QSpinBox::valueChanged, this, &OpenOptionsDialog::showLength);
    showLength();
}

OpenOptions OpenOptionsDialog::options() const
{
    return {m_iq->isChecked(), m_type->currentText().trimmed().toStdString(), m_rate->value(), m_channels->value(),
            m_header->value()};
}

void OpenOptionsDialog::showLength()
{
    try {
        const SampleType type = parseSampleType(options().rawType, "type");
        const auto samples = double((m_fileBytes - m_header->value()) / (type.sampleBytes() * m_channels->value()));
        m_length->setText(tr("%1 s").arg(std::max(0.0, samples) / m_rate->value(), 0, 'g', 6));
        m_iq->setEnabled(!type.isComplex && m_channels->value() % 2 == 0);
    } catch (const Error &error) {
        m_length->setText(messageText(error.why()));
    }
}

} // namespace faintline
